#include "faulttolerance/redistribution/redistribution_json.h"

namespace ambrig {

nlohmann::json RedistributionJson(const std::string& bearing, const RedistributionTable& table,
                                  const std::vector<std::vector<int>>& failed_sets) {
  nlohmann::json sets = nlohmann::json::array();
  for (const std::vector<int>& failed : failed_sets) {
    const Distribution d = table.Lookup(failed);
    nlohmann::json W = nlohmann::json::array();
    for (int j = 0; j < 8; ++j) W.push_back({d.W(j, 0), d.W(j, 1), d.W(j, 2)});
    sets.push_back(
        {{"failed", failed},
         {"class", ToText(d.cls)},
         {"W", W},
         {"residual", d.residual},
         {"rho", d.rho},
         {"unipolar", d.unipolar},
         {"capacity", {{"flux", table.FluxCapacity(failed)}, {"current", d.capacity_current}}}});
  }
  return {{"bearing", bearing},
          {"k", ForceFactor(table.problem())},
          {"c0", table.problem().c0},
          {"sets", sets}};
}

}  // namespace ambrig
