#include "faulttolerance/supervision/coil_probes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ambrig {

namespace {

constexpr double kSlice = 0.02;                      // [s] orbits are compared over
constexpr double kFirst = 10e-3, kWhenGrown = 2e-3;  // [s] after the action
constexpr double kLonger = 4;
constexpr int kLooks = 3;
constexpr double kIdleFirst = 10e-3, kIdleAgain = 50e-3, kBetween = 8e-3;  // [s] of idle coils
constexpr double kGrowth = 1.5, kLeastGrowth = 5e-6;                       // of the orbit; [m]
constexpr double kLeastOfRoom = 0.025;  // growth after a derating, of the rotor's room
// the same of turns that close through a resistance, and for how long [s]: they are driven as
// before, and a coil that is switched off costs an orbit, too
constexpr double kLeastOfLoops = 0.075, kOfLoops = 60e-3;

/// Whether the orbit grew from `before` by half and by `least` more [m].
bool OrbitGrew(double before, double after, double least) {
  return after > kGrowth * before + least;
}

}  // namespace

void CoilProbes::Orbit(double t, double x, double y) {
  const double displacement = std::sqrt(x * x + y * y), place[2] = {x, y};
  if (t >= slice_ends_) {
    slice_[1] = std::exchange(slice_[0], {});
    slice_ends_ = t + kSlice;
  }
  for (int axis = 0; axis < 2; ++axis) {
    slice_[0].least[axis] = std::min(slice_[0].least[axis], place[axis]);
    slice_[0].most[axis] = std::max(slice_[0].most[axis], place[axis]);
  }
  slice_[0].orbit = std::max(slice_[0].orbit, displacement);
  for (auto& [coil, look] : looks_) look.orbit_after = std::max(look.orbit_after, displacement);
  for (auto& [coil, derating] : deratings_) derating.after = std::max(derating.after, displacement);
}

double CoilProbes::Motion() const {
  if (slice_[1].most[0] < slice_[1].least[0]) return kInfinity;
  double most = 0;
  for (int axis = 0; axis < 2; ++axis)
    most = std::max(most, std::max(slice_[0].most[axis], slice_[1].most[axis]) -
                              std::min(slice_[0].least[axis], slice_[1].least[axis]));
  return most;
}

bool CoilProbes::Grown(const Look& look) const {
  return OrbitGrew(look.orbit_before, look.orbit_after, kLeastGrowth);
}

void CoilProbes::ForgetDeratings(double t) {
  std::erase_if(deratings_, [t](const auto& d) { return d.second.since < t; });
}

void CoilProbes::GivenUp(int coil, FaultClass cls, double t) {
  ForgetDeratings(t);
  if (cls == FaultClass::kSwitchStuckOn || returned_[coil] > 0) return;
  Look look;
  look.given_up = t;
  look.next = t + kFirst;
  look.wait = kFirst;
  look.orbit_before = std::max(slice_[0].orbit, slice_[1].orbit);
  look.left = kLooks;
  look.false_current = cls == FaultClass::kCurrentSensor;
  looks_[coil] = look;
}

void CoilProbes::Derated(int coil, double t, double room, bool closed) {
  ForgetDeratings(t);
  deratings_[coil] = {t, t + (closed ? kOfLoops : kFirst),
                      std::max(slice_[0].orbit, slice_[1].orbit), 0,
                      (closed ? kLeastOfLoops : kLeastOfRoom) * room};
}

int CoilProbes::MadeWorse(double t) {
  for (auto it = deratings_.begin(); it != deratings_.end();) {
    const auto [coil, d] = *it;
    const bool grown = OrbitGrew(d.before, d.after, d.least_growth);
    if (!grown && t < d.until) {
      ++it;
      continue;
    }
    it = deratings_.erase(it);
    if (grown) return coil;
  }
  return -1;
}

bool CoilProbes::FalseCurrent(int coil) const {
  const auto it = looks_.find(coil);
  return it != looks_.end() && it->second.false_current;
}

/// A coil whose looks are over, and none of which was in doubt, has a current sensor that is wrong.
bool CoilProbes::FalseCurrentIsOpen(int coil) const {
  if (!FalseCurrent(coil)) return false;
  const Look& look = looks_.at(coil);
  return look.left > 0 || look.disputed;
}

void CoilProbes::Dispute(int coil) { looks_[coil].disputed = true; }

bool CoilProbes::OtherFalseCurrent(int coil) const {
  for (int other = 0; other < kLanes; ++other)
    if (other != coil && (refuted_[other] > 0 || FalseCurrentIsOpen(other))) return true;
  return false;
}

int CoilProbes::Due(double t) const {
  for (const auto& [coil, look] : looks_) {
    const bool early = !look.early && t > look.given_up + kWhenGrown && Grown(look);
    if (look.left > 0 && (t >= look.next || early)) return coil;
  }
  return DueIdle(t);
}

void CoilProbes::Idle(int coil, bool idle, double t) {
  IdleTime& at = idle_[static_cast<std::size_t>(coil)];
  if (idle && !at.idle) at.next = std::max(at.next, t + kIdleFirst);
  at.idle = idle;
}

int CoilProbes::DueIdle(double t) const {
  if (t < idle_again_) return -1;
  for (std::size_t coil = 0; coil < idle_.size(); ++coil)
    if (idle_[coil].idle && t >= idle_[coil].next) return static_cast<int>(coil);
  return -1;
}

void CoilProbes::AnswerIdle(int coil, double t) {
  idle_[static_cast<std::size_t>(coil)].next = t + kIdleAgain;
  idle_again_ = t + kBetween;
}

void CoilProbes::Answer(int coil, bool healthy, double t) {
  if (healthy) {
    returned_[coil] = 1;
    if (FalseCurrent(coil)) refuted_[coil] = 1;
    looks_.erase(coil);
    return;
  }
  Look& look = looks_[coil];
  look.early = true;
  if (t < look.next) return;  // the early look came beside the others
  --look.left;
  look.wait *= kLonger;
  look.next = t + look.wait;
}

}  // namespace ambrig
