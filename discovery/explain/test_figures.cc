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

/// What was found, with the errors of single coils.
Hypothesis WithFoundCoils(Hypothesis h, const Explanation& e) {
  AddCoilErrors(e.nuisances, h.rig);
  return h;
}

/// Sets the floors of the model by the noise that the search used. Rows that no model holds or
/// predicts are left out; a line for each such record goes to `limits`. @throws InputError where no
/// row is left
NoiseFloor PrepareTest(const Hypothesis& nominal, const ExplainOptions& options,
                       const Explanation& e, CaseModel& model, std::vector<std::string>& limits) {
  model.stop = options.stop;
  model.noise_model = e.noise;
  for (const std::string& line : model.LimitToHeld(nominal)) limits.push_back(line);
  RequireCountedRows(model);
  NoiseFloor floor = FindFloor(model, nominal);
  model.LeaveOut(floor.unpredictable);
  return floor;
}

/// The records of the test with their clocks set right, as far as what was found tells them.
Case WithOwnClocks(const Case& test, const ExplainOptions& options, const Explanation& e) {
  CaseModel model(test);
  const Hypothesis nominal = Hypothesis::Base(test.rig);
  std::vector<std::string> limits;
  try {
    UseFoundKinds(nominal, PrepareTest(nominal, options, e, model, limits), e, model);
  } catch (const InputError&) {
    return test;  // whoever compares these records says why they cannot be
  }
  const auto predicted = model.Predict(WithFoundCoils(e.final_fit.hypothesis, e));
  return predicted ? WithClocks(test, ClocksOf(test, AmountsOfNuisances(model, *predicted))) : test;
}

/// Puts the errors of the records `test` into the closure, and what is wrong with them into the
/// warnings.
void TellErrors(const Case& test, const ExplainOptions& options, Explanation& e) {
  CaseModel model(test);
  const Hypothesis nominal = Hypothesis::Base(test.rig);
  const NoiseFloor floor = PrepareTest(nominal, options, e, model, e.warnings);
  for (const DataFault& fault : InspectData(model, floor.clean, nominal))
    e.warnings.push_back("record of the test: " + FaultText(fault));
  model.branches = RowsIn(model, FindBranches(model, nominal));
  UseFoundKinds(nominal, floor, e, model);
  e.closure.test_before = TestErrorOf(model, WithFoundCoils(e.base, e));
  e.closure.test_after = TestErrorOf(model, WithFoundCoils(e.final_fit.hypothesis, e));
}

}  // namespace

void AddTestFigures(const Case& c, const ExplainOptions& options, Explanation& e) {
  const std::optional<Case> test = TestRecordsOf(c);
  if (!test) return;
  e.closure.test_before = e.closure.test_after = std::nan("");
  if (!e.data.empty() || !e.final_fit.Stands()) return;  // nothing was fitted
  if (options.progress) options.progress(0.99, "the records of the test");
  try {
    // Where clocks of other records were off, those of the test may be, too.
    TellErrors(e.clocks_set_right ? WithOwnClocks(*test, options, e) : *test, options, e);
  } catch (const InputError& error) {
    e.warnings.push_back(std::string("no figures of the test: ") + error.what());
  }
}

}  // namespace ambrig
