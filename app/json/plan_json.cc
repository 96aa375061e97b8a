#include "app/json/plan_json.h"

namespace ambrig {

nlohmann::ordered_json PlanJson(const Plan& plan, const std::string& scenario) {
  using Json = nlohmann::ordered_json;
  Json separates = Json::array(), tried = Json::array();
  for (const PlannedPair& p : plan.separates)
    separates.push_back({{"a", p.a},
                         {"b", p.b},
                         {"probability", p.probability},
                         {"distance", p.distance},
                         {"right", p.right},
                         {"draws", p.draws}});
  for (const TriedScenario& t : plan.tried)
    tried.push_back({{"title", t.title},
                     {"size", t.size},
                     {"largest_orbit", t.largest_orbit},
                     {"orbit_at", t.orbit_at},
                     {"least_distance", t.least_distance},
                     {"refused", t.refused}});
  return {{"scenario", scenario},
          {"separates", separates},
          {"largest_orbit", plan.largest_orbit},
          {"duration", plan.duration},
          {"text", plan.text},
          {"title", plan.title},
          {"names", plan.names},
          {"largest_current", plan.largest_current},
          {"record_rate", plan.record_rate},
          {"channels", plan.channels},
          {"tried", tried},
          {"warnings", plan.warnings},
          {"runs", plan.runs}};
}

}  // namespace ambrig
