#pragma once
/// The result of `ambrig analyze` as JSON: speeds in rad/s, frequencies in Hz, lengths in m, SI.
#include <nlohmann/json.hpp>

#include "analysis/rig_analysis.h"

namespace ambrig {

nlohmann::ordered_json AnalysisJson(const RigAnalysis& analysis);

/// "forward", "backward" or "mixed".
const char* SenseName(Whirl whirl);
/// Of one of a row's modes: "either" for two of one pole at rest, which turn in any way that one
/// likes.
const char* SenseName(const ClosedLoopModes& row, const ClosedLoopMode& mode);

}  // namespace ambrig
