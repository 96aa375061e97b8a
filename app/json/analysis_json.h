#pragma once
/// The result of `ambrig analyze` as JSON: speeds in rad/s, frequencies in Hz, lengths in m, SI.
#include <nlohmann/json.hpp>

#include "analysis/rig_analysis.h"

namespace ambrig {

nlohmann::ordered_json AnalysisJson(const RigAnalysis& analysis);

/// "forward", "backward" or "mixed".
const char* SenseName(Whirl whirl);

}  // namespace ambrig
