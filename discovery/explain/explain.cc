#include "discovery/explain/explain.h"

#include <optional>

#include "discovery/calibration/calibration.h"
#include "discovery/case/test_records.h"
#include "discovery/explain/explanation_search.h"
#include "discovery/explain/record_corrections.h"
#include "discovery/explain/record_of_other_machine.h"
#include "discovery/explain/test_figures.h"
#include "discovery/explain/unseen_error.h"

namespace ambrig {

namespace {

/// The search, from the start again where records have to be corrected first.
Explanation SearchCorrected(const Case& c, const ExplainOptions& options) {
  ExplainOptions now = options;
  RecordCorrections all;
  Explanation e;
  std::optional<Case> corrected;
  for (bool again = true; again;) {
    if (all.any()) corrected = Corrected(c, all);
    ExplanationSearch search(corrected ? *corrected : c, now);
    e = search.Run();
    const RecordCorrections& found = search.corrections();
    again = found.any();
    if (!found.clocks_late.empty()) now.clocks = false;
    if (!found.inputs_larger.empty()) --now.inputs;
    all.Add(found);
  }
  ReportCorrections(c, all, e);
  return e;
}

}  // namespace

Explanation Explain(const Case& whole, const ExplainOptions& options) {
  const std::optional<Case> seen = WithoutTestRecords(whole);
  const Case& c = seen ? *seen : whole;
  Explanation e = SearchCorrected(c, options);
  if (const auto fault = RecordOfOtherMachine(c, e)) {
    BelieveFault(*fault, e);
  } else if (const auto record = OnlyUnseen(c, e)) {
    const Case more = WithFitted(c, *record);
    e = TheBetter(c, *record, std::move(e), SearchCorrected(more, options));
  }
  AddTestFigures(whole, options, e);
  const CalibrationTable& table = StoredCalibration();
  if (options.calibrate && table.cases >= kCasesForCalibration) Calibrate(table, e);
  return e;
}

}  // namespace ambrig
