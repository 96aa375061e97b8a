#pragma once
/// JSON of one run; schemas/run-1.json.
#include <nlohmann/json.hpp>

#include "analysis/dropped_modes.h"
#include "simulation/record/run_result.h"
#include "simulation/verdict/expect.h"

namespace ambrig {

/// The JSON of `ambrig run` (docs/guide/files.md).
nlohmann::ordered_json RunJson(const Scenario& scenario, const RunResult& result,
                               const std::vector<ExpectResult>& expect);
/// What stands there under `bending_modes` for a rotor of kind beam.
nlohmann::ordered_json DroppedModesJson(const DroppedModes& modes);

}  // namespace ambrig
