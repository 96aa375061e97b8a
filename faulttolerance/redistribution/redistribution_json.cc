#include "faulttolerance/redistribution/redistribution_json.h"

#include <algorithm>

namespace ambrig {

nlohmann::json RedistributionJson(const std::string& bearing, const RedistributionTable& table,
                                  const std::vector<std::vector<int>>& failed_sets) {
  nlohmann::json sets = nlohmann::json::array();
  for (const std::vector<int>& failed : failed_sets) {
    const Distribution d = table.Lookup(failed);
    RedistributionProblem left = table.problem();
    for (const int coil : failed) left.turns_left[coil - 1] = 0;
    const SolvabilityClass cls = Classify(left);
    // A bearing with failures is never counted on for more than the healthy one, and for nothing
    // where no currents solve the equations.
    const double most = cls == SolvabilityClass::kNone ? 0 : 1;
    nlohmann::json W = nlohmann::json::array();
    for (int j = 0; j < 8; ++j) W.push_back({d.W(j, 0), d.W(j, 1), d.W(j, 2)});
    sets.push_back({{"failed", failed},
                    {"class", ToText(cls)},
                    {"W", W},
                    {"residual", d.residual},
                    {"rho", d.rho},
                    {"unipolar", d.unipolar},
                    {"capacity",
                     {{"flux", std::min(most, table.FluxCapacity(failed))},
                      {"current", std::min(most, d.capacity_current)}}}});
  }
  return {{"bearing", bearing},
          {"k", ForceFactor(table.problem())},
          {"c0", table.problem().c0},
          {"sets", sets}};
}

}  // namespace ambrig
