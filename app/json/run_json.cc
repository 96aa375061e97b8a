#include "app/json/run_json.h"

namespace ambrig {

nlohmann::ordered_json RunJson(const Scenario& scenario, const RunResult& result,
                               const std::vector<ExpectResult>& expect) {
  using Json = nlohmann::ordered_json;
  const auto or_null = [](double v) { return v < 0 ? Json(nullptr) : Json(v); };
  Json events = Json::array();
  for (const RunEvent& e : result.events) {
    Json j = {{"t", e.t}, {"kind", e.kind}, {"target", e.target}};
    if (!e.fault_class.empty()) j["class"] = e.fault_class;
    if (e.fraction != 0) j["fraction"] = e.fraction;
    events.push_back(j);
  }
  Json actions = Json::array();
  for (const CoilAction& a : result.actions)
    actions.push_back({{"t", a.t}, {"coil", a.coil}, {"action", a.action}, {"reason", a.reason}});
  const RunMetrics& m = result.metrics;
  Json orbit = Json::object();
  for (const auto& [name, value] : m.max_orbit) orbit[name] = value;
  Json shares = Json::object();
  for (const auto& [name, value] : result.doubtful_share) shares[name] = value;
  Json wanted = Json::object();
  for (const ExpectResult& e : expect)
    wanted[e.key] = {{"wanted", e.wanted}, {"got", e.got}, {"met", e.met}};
  Json json = {{"name", scenario.name},
               {"seed", scenario.seed},
               {"events", events},
               {"metrics",
                {{"max_orbit", orbit},
                 {"min_clearance_left", m.min_clearance_left},
                 {"peak_current", m.peak_current},
                 {"copper_loss", m.copper_loss},
                 {"detection_delay", or_null(m.detection_delay)},
                 {"redistribution_delay", or_null(m.redistribution_delay)},
                 {"false_alarms", m.false_alarms},
                 {"coil_periods", m.coil_periods},
                 {"longest_contact", m.longest_contact},
                 {"late_orbit", m.settled_orbit},
                 {"real_time_factor", m.real_time_factor}}},
               {"touchdown", result.touchdown},
               {"drop", result.drop},
               {"fault_tolerance",
                {{"actions", actions}, {"doubtful", result.doubtful}, {"doubtful_share", shares}}},
               {"expect", wanted},
               {"notes", result.notes}};
  for (const RunEvent& e : result.events)
    if (e.kind == "model_invalid") json["model_invalid_after"] = e.t;
  return json;
}

nlohmann::ordered_json DroppedModesJson(const DroppedModes& modes) {
  using Json = nlohmann::ordered_json;
  Json bearings = Json::object();
  for (const LostCompliance& b : modes.bearings)
    bearings[b.bearing] = {
        {"kept_compliance", b.kept}, {"lost_compliance", b.lost}, {"lost_at_top", b.lost_at_top}};
  return {{"kept", modes.kept},
          {"dropped", modes.dropped},
          {"top", modes.top},
          {"dropped_frequencies", modes.frequency},
          {"residual_frequencies", modes.residual},
          {"bearings", bearings}};
}

}  // namespace ambrig
