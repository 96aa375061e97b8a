#pragma once
/// JSON of the identification: `ambrig compare` and `ambrig explain`; schemas/compare-1.json,
/// explain-1.json.
#include <nlohmann/json.hpp>

#include "discovery/decision/compare.h"
#include "discovery/decision/explanation.h"

namespace ambrig {

/// JSON of `ambrig compare` and `ambrig explain` (docs/guide/files.md).
nlohmann::ordered_json CompareJson(const Comparison& comparison);
nlohmann::ordered_json ExplainJson(const Explanation& explanation);

}  // namespace ambrig
