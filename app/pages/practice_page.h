#pragma once
#include <string>

#include "discovery/practice/practice_result.h"

namespace ambrig {

/// The page of `ambrig practice`: reliability diagram, coverage of the sets, what was said of every
/// law family and of wrong data, every case. `calibrated`: of the cases that were not fitted; may
/// be nullptr. @throws InputError when the file cannot be written.
void WritePracticeReport(const std::vector<PracticeResult>& results,
                         const PracticeSummary& as_computed, const PracticeSummary* calibrated,
                         const std::string& file);

}  // namespace ambrig
