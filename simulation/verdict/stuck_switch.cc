#include "simulation/verdict/stuck_switch.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "rig/clearance.h"
#include "rig/magnet_inverse.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

/// The pull along `d` at one place, a quadratic function of every coil's current.
struct Pull {
  MagnetForce force;
  Eigen::Vector2d place, d;
  double Along(const Eigen::VectorXd& i) const {
    const Eigen::VectorXd f = force(i, place);
    return f.dot(d.head(f.size()));
  }
};

/// Sets i[k] to the least pull within [lo, hi]: ends, or the vertex of the parabola
/// through three points.
void LeastOverOne(const Pull& pull, double lo, double hi, Eigen::Index k, Eigen::VectorXd& i) {
  const double middle = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
  const auto at = [&](double v) {
    i[k] = v;
    return pull.Along(i);
  };
  const double low = at(lo), mid = at(middle), high = at(hi);
  const double curve = 0.5 * (low + high) - mid, slope = 0.5 * (high - low);
  double best = low <= high ? lo : hi;
  if (curve > 0) best = middle + half * std::clamp(-slope / (2 * curve), -1.0, 1.0);
  i[k] = best;
}

/// Least pull with coil `stuck` at `current`, all others within the amplifiers' range: from
/// every corner of it, coil by coil until nothing is gained.
double LeastPull(const Pull& pull, Eigen::Index coils, Eigen::Index stuck, double current,
                 double lo, double hi) {
  double least = kInfinity;
  for (unsigned corner = 0; corner < (1u << coils); ++corner) {
    if (corner >> stuck & 1u) continue;
    Eigen::VectorXd i(coils);
    for (Eigen::Index k = 0; k < coils; ++k) i[k] = corner >> k & 1u ? hi : lo;
    i[stuck] = current;
    double now = pull.Along(i), before = kInfinity;
    while (now < before - 1e-9 * std::abs(now)) {
      before = now;
      for (Eigen::Index k = 0; k < coils; ++k)
        if (k != stuck) LeastOverOne(pull, lo, hi, k, i);
      now = pull.Along(i);
    }
    least = std::min(least, now);
  }
  return least;
}

/// Largest current of the stuck coil, up to `end`, against which the others hold at
/// the pull's place.
template <class Holds>
double LargestHeld(const Holds& holds, double end) {
  if (holds(end)) return end;
  double held = 0, lost = end;
  for (int k = 0; k < 24; ++k) (holds(0.5 * (held + lost)) ? held : lost) = 0.5 * (held + lost);
  return held;
}

/// " (passed 0.48 ms after the fault)" when the record has the current pass `limit`.
std::string WhenPassed(const Record& record, const ChannelId& id, double fault, double limit) {
  const Channel* i = Find(record, id);
  for (std::size_t row = 0; i && row < i->samples.size(); ++row)
    if (record.TimeAt(row) >= fault && i->samples[row] > limit)
      return fmt::format(" (passed {:.3g} ms after the fault)", 1e3 * (record.TimeAt(row) - fault));
  return "";
}

}  // namespace

StuckSwitchLimit LimitOfStuckSwitch(const RigParameters& rig, std::size_t bearing, int coil) {
  const BearingParameters& b = rig.bearings[bearing];
  const AmplifierParameters& a = rig.amplifier;
  const Eigen::Index coils = b.coils();
  StuckSwitchLimit limit;
  limit.end = std::max(0.0, a.bus_voltage - 2 * a.switch_drop) / b.kind->stator(b).resistance[coil];
  Pull pull{MagnetForceOf(b), Eigen::Vector2d::Zero(), Eigen::Vector2d::UnitX()};
  Eigen::VectorXd alone = Eigen::VectorXd::Zero(coils);
  const Eigen::VectorXd rest = pull.force(alone, pull.place);
  alone[coil] = limit.end;
  const Eigen::VectorXd pulled = pull.force(alone, pull.place) - rest;
  if (!(pulled.norm() > 0)) return {limit.end, limit.end, limit.end};
  pull.d.setZero();
  pull.d.head(pulled.size()) = pulled.normalized();
  const auto share = WeightShares(rig)[bearing];
  const double carried = pull.d.dot(Eigen::Vector2d(share[0], share[1]));
  const double lo = a.quadrants < 3 ? 0 : -a.i_max;
  const auto holds = [&](double current) {
    return LeastPull(pull, coils, coil, current, lo, a.i_max) <= carried;
  };
  limit.centred = LargestHeld(holds, limit.end);
  pull.place = -ClearanceOf(b) * pull.d;
  limit.far = LargestHeld(holds, limit.end);
  return limit;
}

void NoteStuckSwitches(const RigParameters& rig, const Scenario& scenario, RunResult& result) {
  if (!result.touchdown && !result.drop) return;
  for (const FaultSpec& fault : scenario.faults) {
    if (fault.kind != "switch-stuck-on") continue;
    for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
      const std::string name = rig.bearings[k].name + ".coil";
      if (!fault.target.starts_with(name)) continue;
      const int coil = std::stoi(fault.target.substr(name.size())) - 1;
      const StuckSwitchLimit limit = LimitOfStuckSwitch(rig, k, coil);
      if (limit.centred >= limit.end) continue;
      const std::string far =
          limit.far < limit.end
              ? fmt::format(" and {:.3g} A at the far side of its clearance", limit.far)
              : "";
      result.notes.push_back(fmt::format(
          "{} stuck on: its current rises to {:.3g} A; the other coils within i_max = {:.3g} A "
          "hold "
          "the shaft against {:.3g} A with it centred{}{}: only cutting that coil's supply could "
          "keep "
          "it{}",
          fault.target, limit.end, rig.amplifier.i_max, limit.centred,
          WhenPassed(result.record, {ChannelKind::kCoilCurrent, rig.bearings[k].name, coil},
                     fault.time, limit.centred),
          far, limit.far < limit.end ? "" : " there"));
    }
  }
}

}  // namespace ambrig
