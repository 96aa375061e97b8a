/// Events of the continuous rig: diodes, contacts, voltages, faults, periods.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/index.h"
#include "core/math/no_solution.h"

#include "simulation/continuous/continuous_rig.h"
#include "simulation/sampled/instants.h"

namespace ambrig {

namespace {
constexpr double kNoCurrent = 1e-9;  // [A] counts as zero when the diodes are looked at
constexpr double kNoRise = 1e-3;     // [A/s] a slope that is zero to rounding
constexpr int kBlockRounds = 8, kMostRounds = 200;
}  // namespace

void ContinuousRig::Settle() {
  const bool unipolar = rig_.plant.bearings[0].lanes.unipolar;
  if (!rig_.clamped) {
    const std::size_t dof = AsSize(rig_.plant.rotor.dof());
    std::copy(rig_.motion.q.begin(), rig_.motion.q.begin() + static_cast<std::ptrdiff_t>(dof),
              y_.begin() + static_cast<std::ptrdiff_t>(q_at_));
    std::copy(rig_.motion.v.begin(), rig_.motion.v.begin() + static_cast<std::ptrdiff_t>(dof),
              y_.begin() + static_cast<std::ptrdiff_t>(v_at_));
    y_[spin_at_] = rig_.motion.theta;
    y_[spin_at_ + 1] = rig_.motion.Omega;
  }
  t0_ = rig_.motion.t;
  tau_ = 0;
  for (std::size_t k = 0; k < bearings_.size(); ++k) {
    Bearing& b = bearings_[k];
    double current[kMaxWindings] = {}, px, py;
    for (int j = 0; j < b.network.coils; ++j) {
      current[j] = rig_.control[k].set_point[j];
      b.network.windings[AsSize(j)].conducts = !unipolar || current[j] > 0;
    }
    Place(k, rig_.motion, &px, &py);
    b.network.Linkages(current, px, py, y_.data() + b.at);
  }
  Refresh();
  for (std::size_t k = 0; k < bearings_.size(); ++k)
    rig_.bearings[k].fx = now_[k].fx, rig_.bearings[k].fy = now_[k].fy;
}

void ContinuousRig::Refresh() {
  const MotionState s = MotionOf(tau_, y_.data());
  for (std::size_t k = 0; k < bearings_.size(); ++k) {
    double px, py;
    Place(k, s, &px, &py);
    bearings_[k].network.Solve(y_.data() + bearings_[k].at, px, py, now_[k]);
  }
}

void ContinuousRig::BeginPeriod(long long n) {
  t0_ = static_cast<double>(n) * rig_.T;
  tau_ = 0;
  ++periods_;
  for (const Bearing& b : bearings_)
    std::fill_n(y_.begin() + static_cast<std::ptrdiff_t>(b.force_at), 2 + b.network.coils, 0.0);
  restart_ = true;
}

void ContinuousRig::SetVoltage(std::size_t k, int coil, const Drive& drive) {
  Bearing& b = bearings_[k];
  const std::size_t j = AsSize(coil);
  const bool unipolar = rig_.plant.bearings[k].lanes.unipolar;
  const int way = unipolar ? 1 : !drive.released ? 0 : now_[k].i[j] < 0 ? -1 : 1;
  // Without diodes in its way a coil of four quadrants always conducts.
  const bool driven = unipolar ? drive.driven : !drive.released;
  const double volts = drive.released && !unipolar ? -way * std::abs(drive.volts) : drive.volts;
  if (b.volts[j] == volts && b.driven[j] == driven && b.way[j] == way) return;  // a mere sample
  b.volts[j] = volts;
  b.driven[j] = driven;
  b.way[j] = way;
  restart_ = true;
}

void ContinuousRig::DecideConduction(std::size_t k, int must_block, int must_carry) {
  // Coils without current: one carries where its current would rise, one blocks where the others'
  // flux already takes more than its voltage (i >= 0, n dφ/dt - v >= 0, one of them zero).
  Bearing& b = bearings_[k];
  const MotionState s = MotionOf(tau_, y_.data());
  const PlaneMap& plane = rig_.plant.bearings[k].plane;
  double px, py, slope[kMaxWindings];
  Place(k, s, &px, &py);
  const double vx = rig_.clamped ? 0 : plane.X(s.v), vy = rig_.clamped ? 0 : plane.Y(s.v);
  NetworkRates r;
  const auto solve = [&] {
    b.network.Solve(y_.data() + b.at, px, py, now_[k]);
    Slopes(b, now_[k], slope);
    b.network.Rates(now_[k], slope, px, py, vx, vy, r);
  };
  const auto carry = [&](int j) {
    Winding& w = b.network.windings[AsSize(j)];
    w.conducts = true;
    y_[b.at + AsSize(j)] = b.network.OpenLinkage(now_[k], AsSize(j));
  };
  b.network.Solve(y_.data() + b.at, px, py, now_[k]);
  if (must_block >= 0) b.network.windings[AsSize(must_block)].conducts = false;
  if (must_carry >= 0) carry(must_carry);
  for (int j = 0; j < b.network.coils; ++j) {
    const Winding& w = b.network.windings[AsSize(j)];
    if (!w.broken && !w.conducts && b.driven[AsSize(j)] && j != must_block) carry(j);
  }
  // All at once first; should that not settle, one at a time by the lowest index, which ends for
  // the positive definite inductance (Murty 1974).
  for (int round = 0; round < kMostRounds; ++round) {
    solve();
    const bool one = round >= kBlockRounds;
    bool changed = false;
    for (int j = 0; j < b.network.coils && !(one && changed); ++j) {
      Winding& w = b.network.windings[AsSize(j)];
      if (w.broken) continue;
      if (w.conducts) {
        const int way = b.way[AsSize(j)];
        if (way == 0 || way * now_[k].i[AsSize(j)] > kNoCurrent || way * r.i[AsSize(j)] >= -kNoRise)
          continue;
        w.conducts = false;
      } else {
        if (!one || !b.driven[AsSize(j)] || j == must_block) continue;
        if (b.volts[AsSize(j)] - w.n * r.phi[AsSize(w.pole)] <= kNoRise * w.leakage) continue;
        carry(j);
      }
      changed = true;
    }
    if (changed) continue;
    if (one) return;
    round = kBlockRounds - 1;  // nothing to block: look for coils to let go
  }
}

void ContinuousRig::Restart() {
  for (std::size_t k = 0; k < bearings_.size(); ++k) DecideConduction(k, -1, -1);
  const double t = t0_ + tau_ + 1e-12;
  active_load_ = DofVector{};
  for (std::size_t l = 0; l < load_Q_.size(); ++l) {
    const LoadSpec& load = rig_.scenario.loads[l];
    if (t < load.start || t >= load.stop) continue;
    for (std::size_t d = 0; d < active_load_.size(); ++d) active_load_[d] += load_Q_[l][d];
  }
  if (!rig_.clamped && !free_spin_) {
    y_[spin_at_] = rig_.scenario.speed.Angle(t0_ + tau_);
    y_[spin_at_ + 1] = rig_.scenario.speed.Speed(t0_ + tau_);
  }
  free_spin_ = rig_.plant.rotor.SpeedIsFree(t) && rig_.plant.rotor.parameters().inertia_polar > 0;
  restart_ = false;
}

void ContinuousRig::CountSteps() {
  const long now = solver_->steps();
  steps_ += now - counted_ + 1;
  counted_ = now;
  if (steps_ > kStepsAtOnce + steps_a_period_ * periods_)
    throw NoSolution(fmt::format("they take more than {} steps a period up to t = {:.4g} s",
                                 steps_a_period_, t0_ + tau_));
}

void ContinuousRig::AdvanceTo(double tau) {
  for (const LoadSpec& l : rig_.scenario.loads)
    for (double edge : {l.start, l.stop})
      if (std::abs(t0_ + tau_ - edge) < 1e-12) restart_ = true;
  while (tau - tau_ > kSameInstant) {
    if (restart_) {
      Restart();
      solver_->Restart(tau_, y_, tau - tau_);
      counted_ = 0;
      ++events_;
    }
    const OdeSolver::Outcome out = solver_->Advance(tau, y_);
    tau_ = out.t;
    CountSteps();
    if (out.root) HandleRoots(solver_->roots());
  }
  Refresh();
}

void ContinuousRig::HandleRoots(const std::vector<int>& roots) {
  std::size_t r = 0;
  for (std::size_t k = 0; k < bearings_.size(); ++k)
    for (int j = 0; j < bearings_[k].network.coils; ++j, ++r) {
      if (roots[r] == 0) continue;
      const bool conducts = bearings_[k].network.windings[AsSize(j)].conducts;
      DecideConduction(k, conducts ? j : -1, conducts ? -1 : j);
    }
  restart_ = true;  // contacts change their law by themselves
}

void ContinuousRig::BreakCoil(std::size_t k, int coil) {
  bearings_[k].network.Break(coil);
  Refresh();
  restart_ = true;
}

void ContinuousRig::ShortTurns(std::size_t k, int coil, double share, double resistance) {
  Bearing& b = bearings_[k];
  int loop = -1;
  if (std::isfinite(resistance)) {
    loop = b.loops.front();
    b.loops.erase(b.loops.begin());
  }
  if (!b.network.windings[AsSize(coil)].broken)
    b.network.Short(coil, loop, share, resistance, now_[k], y_.data() + b.at);
  Refresh();
  restart_ = true;
}

void ContinuousRig::EndPeriod() {
  rig_.motion = MotionOf(tau_, y_.data());
  for (std::size_t k = 0; k < bearings_.size(); ++k) {
    SampledBearing& b = rig_.bearings[k];
    b.fx_before = std::exchange(b.fx, y_[bearings_[k].force_at] / tau_);
    b.fy_before = std::exchange(b.fy, y_[bearings_[k].force_at + 1] / tau_);
  }
}

double ContinuousRig::MeanCurrent(std::size_t b, int j, double over) const {
  return y_[bearings_[b].charge_at + AsSize(j)] / over;
}

EnergyBalance ContinuousRig::Energies() const {
  EnergyBalance e;
  const double* out = y_.data() + energy_at_;
  e.electrical = out[0];
  e.drive = out[1];
  e.copper = out[2];
  e.contact = out[3];
  e.magnetic_work = out[4];
  const MotionState s = MotionOf(tau_, y_.data());
  for (std::size_t k = 0; k < bearings_.size(); ++k) {
    double px, py;
    Place(k, s, &px, &py);
    e.field += bearings_[k].network.FieldEnergy(now_[k], px, py);
  }
  e.rotor = rig_.plant.rotor.Energy(s);
  return e;
}

}  // namespace ambrig
