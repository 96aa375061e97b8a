#include "simulation/verdict/contact_watch.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {
constexpr double kHop = 0.020;  // [s] free for longer: the contact is over
}  // namespace

ContactWatch::ContactWatch(const RotorModel& rotor, const Scenario& scenario, double T)
    : rotor_(rotor), scenario_(scenario), T_(T), planes_(rotor.auxiliaries().size() + 1) {}

void ContactWatch::Period(const MotionState& s, bool first, RunResult& result) {
  for (std::size_t k = 0; k < planes_.size(); ++k) Watch(planes_[k], k, s, first && k == 0, result);
}

void ContactWatch::Watch(Plane& plane, std::size_t k, const MotionState& s, bool first,
                         RunResult& result) const {
  RunMetrics& m = result.metrics;
  const bool axial = k == rotor_.auxiliaries().size();
  const double depth = axial ? rotor_.AxialPenetration(s) : rotor_.Penetration(s, k);
  if (!std::isfinite(depth)) return;
  m.min_clearance_left = first ? -depth : std::min(m.min_clearance_left, -depth);
  if (depth <= 0 && plane.touching_since < 0) return;
  const std::string name = axial ? "z" : rotor_.auxiliaries()[k].name;
  if (depth <= 0) {
    m.longest_contact = std::max(m.longest_contact, s.t - plane.touching_since);
    plane.touching_since = -1;
    result.events.push_back({s.t, "lift_off", name, "", 0});
    return;
  }
  if (plane.touching_since < 0) {
    plane.touching_since = s.t;
    if (s.t - plane.last_touch > kHop) {
      plane.contact_since = s.t;
      plane.touches = 0;
    }
    ++plane.touches;
    if (scenario_.start != StartState::kResting || s.t > 1.5 * T_) {
      result.events.push_back({s.t, "touchdown", name, "", 0});
      result.touchdown = true;
    }
  }
  plane.last_touch = s.t;
  if (s.t - plane.contact_since > scenario_.drop_limit) Drop(name, s.t, result);
}

void ContactWatch::Drop(const std::string& name, double t, RunResult& result) {
  if (!result.drop) result.events.push_back({t, "drop", name, "", 0});
  result.drop = true;
}

void ContactWatch::Finish(const MotionState& s, RunResult& result) {
  for (const Plane& plane : planes_) {
    const bool touching = plane.touching_since >= 0;
    if (touching)
      result.metrics.longest_contact =
          std::max(result.metrics.longest_contact, s.t - plane.touching_since);
    const bool bouncing = plane.touches > 1 && s.t - plane.last_touch < kHop;
    if (touching || bouncing) Drop("rotor", s.t, result);
  }
}

}  // namespace ambrig
