#include "campaign/drop_reason.h"

#include <algorithm>

#include "simulation/verdict/detection_score.h"

namespace ambrig {

bool IsFalseAction(const Scenario& scenario, const CoilAction& action) {
  return (action.action == "disable" || action.action == "derate") &&
         std::ranges::none_of(scenario.faults, [&](const FaultSpec& f) {
           return f.target == action.coil && f.time <= action.t;
         });
}

std::string DropReason(const RunPlan& plan, const PlannedRun& p, const RunResult& r) {
  const auto touch = std::ranges::find(r.events, "touchdown", &RunEvent::kind);
  if (touch == r.events.end() || p.scenario.faults.empty() || !p.margin) return "";
  const double contact = touch->t;
  if (contact < p.scenario.faults.front().time) return "bounced before";
  const double margin = plan.MarginAt(p, contact).value_or(0);
  if (margin < 1) return "load not carried";
  const DetectionScore score = ScoreDetection(p.scenario.faults, r.events);
  for (std::size_t k = 0; k < score.faults.size(); ++k) {
    const double since = contact - p.scenario.faults[k].time;
    if (since > 0 && score.faults[k].detected.value_or(kInfinity) > since)
      return "fault not detected";
  }
  if (std::ranges::any_of(r.actions, [&](const CoilAction& a) {
        return a.t <= contact && IsFalseAction(p.scenario, a);
      }))
    return "healthy coil given up";
  return margin < kMarginOfSurvival ? "little margin" : "transition";
}

}  // namespace ambrig
