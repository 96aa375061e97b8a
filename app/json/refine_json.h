#pragma once
#include <nlohmann/json.hpp>

#include "discovery/shape/refine.h"

namespace ambrig {

/// JSON of `ambrig refine` (docs/guide/files.md).
nlohmann::ordered_json RefineJson(const Refinement& r);

}  // namespace ambrig
