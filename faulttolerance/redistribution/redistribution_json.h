#pragma once
/// What `ambrig redistribute --json` prints (files.md): class, W and capacities of failure sets.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "faulttolerance/redistribution/redistribution_table.h"

namespace ambrig {

/// { "bearing", "k", "c0", "sets": [ { "failed", "class", "W", "residual", "rho", "unipolar",
/// "capacity": { "flux", "current" } } ] }. capacity.current is that of the W given; capacity.flux
/// is the most that any exact W of the set allows when only the pole fluxes are limited.
nlohmann::json RedistributionJson(const std::string& bearing, const RedistributionTable& table,
                                  const std::vector<std::vector<int>>& failed_sets);

}  // namespace ambrig
