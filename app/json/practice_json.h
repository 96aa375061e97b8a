#pragma once
/// JSON of practice cases: journal and summary; schemas/practice-1.json.
#include <nlohmann/json.hpp>

#include "discovery/practice/practice_result.h"

namespace ambrig {

/// One line of the journal of `ambrig practice`, and back.
nlohmann::ordered_json PracticeResultJson(const PracticeResult& result);
/// @throws nlohmann::json::exception for text that is no such line.
PracticeResult PracticeResultOf(const nlohmann::ordered_json& line);

/// What `ambrig practice --json` writes: counts as computed and calibrated, every case.
nlohmann::ordered_json PracticeJson(const std::vector<PracticeResult>& results,
                                    const PracticeSummary& as_computed,
                                    const PracticeSummary* calibrated);

}  // namespace ambrig
