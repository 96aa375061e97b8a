#include "discovery/explain/test_figures.h"

#include <algorithm>
#include <cmath>

#include "discovery/case/test_records.h"
#include "discovery/model/coil_errors.h"
#include "discovery/model/residual.h"
#include "discovery/search/likelihood.h"

namespace ambrig {

namespace {

/// What differs from record to record, of the kinds that the search used.
void UseFoundKinds(const Hypothesis& nominal, const NoiseFloor& floor, const Explanation& e,
                   CaseModel& model) {
  std::vector<NuisanceKind> kinds =
      NuisanceKindsOf(model, nominal, floor.clean, model.data().nuisances.any());
  std::erase_if(kinds, [&](const NuisanceKind& kind) {
    return std::ranges::none_of(e.nuisances, [&](const NuisanceFound& found) {
      return !found.record.empty() && found.name == kind.name;
    });
  });
  if (!kinds.empty())
    model.nuisances.Use(model, kinds, RowWeight(model, 1, floor.effective_sample_size));
}

/// rms over the floor; infinite where the rotor is lost.
double TestErrorOf(const CaseModel& model, const Hypothesis& h) {
  const auto predicted = model.Predict(h);
  return predicted ? Ratio(model, Residual(model, *predicted), Which::kAll) : kInfinity;
}

}  // namespace

void AddTestFigures(const Case& c, const ExplainOptions& options, Explanation& e) {
  const std::optional<Case> test = TestRecordsOf(c);
  if (!test) return;
  e.closure.test_before = e.closure.test_after = std::nan("");
  if (!e.data.empty() || !e.final_fit.Stands()) return;  // nothing was fitted
  if (options.progress) options.progress(0.99, "the records of the test");
  CaseModel model(*test);
  model.stop = options.stop;
  model.noise_model = e.noise;
  Hypothesis before = e.base, after = e.final_fit.hypothesis;
  AddCoilErrors(e.nuisances, before.rig);
  AddCoilErrors(e.nuisances, after.rig);
  try {
    const Hypothesis nominal = Hypothesis::Base(test->rig);
    for (const std::string& line : model.LimitToHeld(nominal)) e.warnings.push_back(line);
    RequireCountedRows(model);
    const NoiseFloor floor = FindFloor(model, nominal);
    model.LeaveOut(floor.unpredictable);
    for (const DataFault& fault : InspectData(model, floor.clean, nominal))
      e.warnings.push_back("record of the test: " + FaultText(fault));
    model.branches = RowsIn(model, FindBranches(model, nominal));
    UseFoundKinds(nominal, floor, e, model);
    e.closure.test_before = TestErrorOf(model, before);
    e.closure.test_after = TestErrorOf(model, after);
  } catch (const InputError& error) {
    e.warnings.push_back(std::string("no figures of the test: ") + error.what());
  }
}

}  // namespace ambrig
