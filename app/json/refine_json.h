#pragma once
/// JSON of the shape of a law; schemas/refine-1.json.
#include <nlohmann/json.hpp>

#include "discovery/refine/refine.h"

namespace ambrig {

/// JSON of `ambrig refine` (docs/guide/files.md).
nlohmann::ordered_json RefineJson(const Refinement& r);

}  // namespace ambrig
