#pragma once
#include <nlohmann/json.hpp>

#include "simulation/record/run_result.h"
#include "simulation/verdict/expect.h"

namespace ambrig {

/// The JSON of `ambrig run` (docs/guide/files.md).
nlohmann::ordered_json RunJson(const Scenario& scenario, const RunResult& result,
                               const std::vector<ExpectResult>& expect);

}  // namespace ambrig
