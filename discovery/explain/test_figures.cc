#include "discovery/explain/test_figures.h"

#include <algorithm>
#include <cmath>

#include "discovery/case/test_records.h"
#include "discovery/data/clock_shift.h"
#include "discovery/explain/record_corrections.h"
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
    if (e.clocks_set_right && kind.name == kTimeShift) return false;
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

/// Puts the errors of the records `test` into the closure, and what is wrong with them into the
/// warnings. Where clocks of other records were off, these may be, too: they are set right first.
void TellErrors(const Case& test, const ExplainOptions& options, bool clocks, Explanation& e) {
  CaseModel model(test);
  model.stop = options.stop;
  model.noise_model = e.noise;
  Hypothesis before = e.base, after = e.final_fit.hypothesis;
  AddCoilErrors(e.nuisances, before.rig);
  AddCoilErrors(e.nuisances, after.rig);
  const Hypothesis nominal = Hypothesis::Base(test.rig);
  const std::vector<std::string> limits = model.LimitToHeld(nominal);
  RequireCountedRows(model);
  const NoiseFloor floor = FindFloor(model, nominal);
  model.LeaveOut(floor.unpredictable);
  const std::vector<DataFault> faults = InspectData(model, floor.clean, nominal);
  UseFoundKinds(nominal, floor, e, model);
  if (const auto predicted = clocks ? model.Predict(after) : std::nullopt) {
    const std::vector<double> late = ClocksOf(test, AmountsOfNuisances(model, *predicted));
    if (std::ranges::any_of(late, [](double seconds) { return seconds != 0; }))
      return TellErrors(WithClocks(test, late), options, false, e);
  }
  e.warnings.insert(e.warnings.end(), limits.begin(), limits.end());
  for (const DataFault& fault : faults)
    e.warnings.push_back("record of the test: " + FaultText(fault));
  model.branches = RowsIn(model, FindBranches(model, nominal));
  e.closure.test_before = TestErrorOf(model, before);
  e.closure.test_after = TestErrorOf(model, after);
}

}  // namespace

void AddTestFigures(const Case& c, const ExplainOptions& options, Explanation& e) {
  const std::optional<Case> test = TestRecordsOf(c);
  if (!test) return;
  e.closure.test_before = e.closure.test_after = std::nan("");
  if (!e.data.empty() || !e.final_fit.Stands()) return;  // nothing was fitted
  if (options.progress) options.progress(0.99, "the records of the test");
  try {
    TellErrors(*test, options, e.clocks_set_right, e);
  } catch (const InputError& error) {
    e.warnings.push_back(std::string("no figures of the test: ") + error.what());
  }
}

}  // namespace ambrig
