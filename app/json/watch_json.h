#pragma once
/// JSON of `ambrig watch`: the lines of its journal and its document (docs/guide/watch.md).
#include <nlohmann/json.hpp>

#include "discovery/decision/explanation.h"
#include "discovery/watch/record_state.h"

namespace ambrig {

/// "ratio", "ratio_fitted", "explained", "noise", "floors", "parameters", "data_faults" where it is
/// wrong. `reference`: each parameter also gets its band and its change; nullptr: without.
nlohmann::ordered_json StateJson(const RecordState& state, const RecordState* reference);
/// What a later record is compared with. @throws nlohmann::json::exception
RecordState ReferenceFromJson(const nlohmann::ordered_json& json);

/// Each with "text", a sentence: "bearings.A.gap = 405.1 um, was 400.0 um (+12 sd)".
nlohmann::ordered_json LeftJson(const std::vector<LeftBand>& left);
/// What would explain it: "verdict", "set", "parameter_shifts" and "text".
nlohmann::ordered_json WatchExplanationJson(const Explanation& e);

}  // namespace ambrig
