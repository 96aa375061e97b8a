#include "simulation/verdict/detection_score.h"

#include <algorithm>

#include "scenarios/faults/fault.h"

namespace ambrig {

namespace {

FaultScore ScoreOf(const FaultSpec& fault, const std::vector<RunEvent>& events, double lost) {
  FaultScore score;
  score.judged = fault.time < lost;
  if (!score.judged) return score;
  const std::string bearing = fault.target.substr(0, fault.target.find('.'));
  for (const RunEvent& e : events) {
    if (e.t < fault.time) continue;
    const double after = e.t - fault.time;
    if (e.kind == "redistributed" && e.target == bearing && !score.redistributed)
      score.redistributed = after;
    if (e.target != fault.target) continue;
    if (e.kind == "detected" && !score.detected) score.detected = after;
    if (e.kind == "classified") score.last_class = e.fault_class;
  }
  score.of_a_coil = FaultByKind(fault.kind).observer == FaultObserver::kCoilDetector;
  score.right_class = score.last_class == FaultByKind(fault.kind).seen_as;
  return score;
}

bool IsFalse(const RunEvent& alarm, const std::vector<FaultSpec>& faults) {
  return std::ranges::none_of(
      faults, [&](const FaultSpec& f) { return f.target == alarm.target && alarm.t >= f.time; });
}

double Longest(const std::vector<FaultScore>& faults, std::optional<double> FaultScore::*delay) {
  double longest = -1;
  for (const FaultScore& f : faults) longest = std::max(longest, (f.*delay).value_or(-1));
  return longest;
}

}  // namespace

double LostAt(const std::vector<RunEvent>& events) {
  const auto lost = std::ranges::find_if(
      events, [](const RunEvent& e) { return e.kind == "drop" || e.kind == "model_invalid"; });
  return lost == events.end() ? kInfinity : lost->t;
}

std::size_t DetectionScore::judged() const {
  return static_cast<std::size_t>(std::ranges::count_if(faults, &FaultScore::judged));
}

std::size_t DetectionScore::detected() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(faults, [](const FaultScore& f) { return f.detected.has_value(); }));
}

bool DetectionScore::a_coil_was_missed() const {
  return std::ranges::any_of(
      faults, [](const FaultScore& f) { return f.judged && f.of_a_coil && !f.detected; });
}

std::size_t DetectionScore::judged_coils() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(faults, [](const FaultScore& f) { return f.judged && f.of_a_coil; }));
}

std::size_t DetectionScore::redistributed() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      faults, [](const FaultScore& f) { return f.of_a_coil && f.redistributed.has_value(); }));
}

std::size_t DetectionScore::right_class() const {
  return static_cast<std::size_t>(std::ranges::count_if(faults, &FaultScore::right_class));
}

double DetectionScore::longest_detection() const { return Longest(faults, &FaultScore::detected); }

double DetectionScore::longest_redistribution() const {
  return Longest(faults, &FaultScore::redistributed);
}

DetectionScore ScoreDetection(const std::vector<FaultSpec>& faults,
                              const std::vector<RunEvent>& events) {
  DetectionScore score;
  const double lost = LostAt(events);
  for (const FaultSpec& fault : faults) score.faults.push_back(ScoreOf(fault, events, lost));
  score.false_alarms =
      static_cast<std::size_t>(std::ranges::count_if(events, [&](const RunEvent& e) {
        return e.kind == "detected" && e.t <= lost && IsFalse(e, faults);
      }));
  return score;
}

void ScoreDetection(const Scenario& scenario, RunResult& result) {
  const DetectionScore score = ScoreDetection(scenario.faults, result.events);
  result.metrics.detection_delay = score.a_coil_was_missed() ? -1 : score.longest_detection();
  result.metrics.redistribution_delay =
      score.redistributed() == score.judged_coils() ? score.longest_redistribution() : -1;
  result.metrics.false_alarms = static_cast<double>(score.false_alarms);
}

}  // namespace ambrig
