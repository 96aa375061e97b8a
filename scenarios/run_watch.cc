#include "scenarios/run_watch.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

RunWatch::RunWatch(const SampledRig& rig, RunResult& result)
    : rig_(rig), result_(result), contact_since_(rig.plant.rotor.auxiliaries().size() + 1, -1) {}

void RunWatch::Event(const std::string& kind, const std::string& target) {
  result_.events.push_back({std::max(rig_.motion.t, 0.0), kind, target, "", 0});
}

void RunWatch::Period(long long n, double copper, double peak_current) {
  if (n < 0) return;
  RunMetrics& m = result_.metrics;
  copper_sum_ += copper;
  m.peak_current = std::max(m.peak_current, peak_current);
  if (rig_.clamped) return;
  for (const SampledBearing& b : rig_.bearings) {
    const double orbit = std::hypot(b.true_x, b.true_y);
    double& most = m.max_orbit[b.plant->name];
    most = std::max(most, orbit);
    if (rig_.motion.t > 0.9 * rig_.scenario.duration) m.late_orbit = std::max(m.late_orbit, orbit);
  }
  for (std::size_t k = 0; k < contact_since_.size(); ++k) Contact(n, k);
}

void RunWatch::Contact(long long n, std::size_t k) {
  const RotorModel& rotor = rig_.plant.rotor;
  const MotionState& s = rig_.motion;
  RunMetrics& m = result_.metrics;
  const bool axial = k == rotor.auxiliaries().size();
  const double depth = axial ? rotor.AxialPenetration(s) : rotor.Penetration(s, k);
  if (!std::isfinite(depth)) return;
  const std::string name = axial ? "z" : rotor.auxiliaries()[k].name;
  m.min_clearance_left = n == 0 && k == 0 ? -depth : std::min(m.min_clearance_left, -depth);
  double& since = contact_since_[k];
  if (depth > 0 && since < 0) {
    since = s.t;
    if (rig_.scenario.start != StartState::kResting || s.t > 1.5 * rig_.T) {
      Event("touchdown", name);
      result_.touchdown = true;
    }
  } else if (depth <= 0 && since >= 0) {
    m.longest_contact = std::max(m.longest_contact, s.t - since);
    since = -1;
    Event("lift_off", name);
  }
  if (since >= 0 && !result_.drop && s.t - since > rig_.scenario.drop_limit) {
    result_.drop = true;
    Event("drop", name);
  }
}

void RunWatch::Finish() {
  RunMetrics& m = result_.metrics;
  m.copper_loss = rig_.periods > 0 ? copper_sum_ / static_cast<double>(rig_.periods) : 0;
  for (double since : contact_since_) {
    if (since < 0) continue;
    m.longest_contact = std::max(m.longest_contact, rig_.motion.t - since);
    if (!result_.drop) Event("drop", "rotor");
    result_.drop = true;
  }
}

}  // namespace ambrig
