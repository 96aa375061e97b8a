#pragma once
/// JSON of the next record; schemas/plan-1.json.
#include <nlohmann/json.hpp>

#include "discovery/plan/plan.h"

namespace ambrig {

/// JSON of `ambrig plan` (docs/guide/files.md). `scenario`: the file that was written.
nlohmann::ordered_json PlanJson(const Plan& plan, const std::string& scenario);

}  // namespace ambrig
