// The whole of an explanation: begun anew whenever records were found that have to be set right first.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "discovery/calibration/calibration.h"
#include "discovery/case/test_records.h"
#include "discovery/data/clock_shift.h"
#include "discovery/data/input_size.h"
#include "discovery/decision/explain.h"
#include "discovery/decision/explainer.h"
#include "discovery/decision/test_figures.h"

namespace ambrig {

namespace {

/// What one search found of the records, on top of what those before it did.
void AddFound(const RecordsSetRight& found, RecordsSetRight& all) {
  if (!found.rows_late.empty()) all.rows_late = found.rows_late;
  all.inputs_larger.resize(std::max(all.inputs_larger.size(), found.inputs_larger.size()), 0);
  for (std::size_t r = 0; r < found.inputs_larger.size(); ++r)
    all.inputs_larger[r] = (1 + all.inputs_larger[r]) * (1 + found.inputs_larger[r]) - 1;
}

/// What was set right before the last search stands in its answer too.
void Tell(const Case& c, const RecordsSetRight& all, Explanation& e) {
  for (std::size_t r = 0; r < all.rows_late.size(); ++r)
    if (all.rows_late[r] != 0)
      e.warnings.push_back(fmt::format("the clock of {} is {} row{} {}: its rows are moved",
                                       c.records[r].data_file, std::abs(all.rows_late[r]),
                                       std::abs(all.rows_late[r]) == 1 ? "" : "s",
                                       all.rows_late[r] > 0 ? "late" : "early"));
  for (std::size_t r = 0; r < all.inputs_larger.size(); ++r) {
    bool told = all.inputs_larger[r] == 0;
    for (NuisanceFound& f : e.nuisances)
      if (f.name == kInputGain && f.record == c.records[r].data_file) {
        f.value = (1 + all.inputs_larger[r]) * (1 + f.value) - 1;
        told = true;
      }
    if (!told)
      e.warnings.push_back(fmt::format(
          "the commands of {} are {:.2f} % {} than its scenario says: they are simulated so",
          c.records[r].data_file, 100 * std::abs(all.inputs_larger[r]),
          all.inputs_larger[r] > 0 ? "larger" : "smaller"));
  }
}

}  // namespace

Explanation Explain(const Case& whole, const ExplainOptions& options) {
  const std::optional<Case> seen = WithoutTestRecords(whole);
  const Case& c = seen ? *seen : whole;
  ExplainOptions now = options;
  RecordsSetRight all;
  Explanation e;
  std::optional<Case> mended;
  for (bool again = true; again;) {
    if (all.any()) mended = WithInputs(WithClocks(c, all.rows_late), all.inputs_larger);
    Explainer explainer(mended ? *mended : c, now);
    e = explainer.Run();
    const RecordsSetRight& found = explainer.set_right();
    again = found.any();
    if (!found.rows_late.empty()) now.clocks = false;
    if (!found.inputs_larger.empty()) --now.inputs;
    AddFound(found, all);
  }
  Tell(c, all, e);
  AddTestFigures(whole, options, e);
  const CalibrationTable& table = StoredCalibration();
  if (options.calibrate && table.cases >= kCasesForCalibration) Calibrate(table, e);
  return e;
}

}  // namespace ambrig
