#include "actuators/magnetics/stator_lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/base/errors.h"

namespace ambrig {

namespace {

/// Whether the switches of lane j are closed at time t of the period, and where the pattern stands.
int SegmentAt(const VoltagePattern& p, int j, double t) {
  return t < p.t1[j] ? 0 : (t < p.t2[j] ? 1 : 2);
}

}  // namespace

void StatorLanes::UpdateConductance(int j) {
  c_[j] = n[j] * inverse_l_[j];
  const auto own = [&](int lane) { return n[lane] * n[lane] * inverse_l_[lane]; };
  const int other = j ^ 1;
  const double nc = coupling == Coupling::kSides ? own(j) + own(other) : own(j);
  const auto set = [&](int lane) {
    g0_[lane] = 1 / (rel0_[lane] + nc);
    dg_[lane] = 1 / (rel1_[lane] + nc) - g0_[lane];
  };
  set(j);
  if (coupling == Coupling::kSides) set(other);
}

void StatorLanes::Block(int j) {
  blocked[j] = true;
  inverse_l_[j] = 0;
  UpdateConductance(j);
}

void StatorLanes::Unblock(int j) {
  if (open[j] || n[j] == 0) return;
  blocked[j] = false;
  inverse_l_[j] = 1 / (leakage[j] + half_rh_[j]);
  UpdateConductance(j);
}

void StatorLanes::SetStep(double h) {
  h_ = h;
  affine_laws_ = true;
  for (FluxLaw* law : laws) {
    law->SetStep(h);
    affine_laws_ = affine_laws_ && law->linear();
  }
  for (int j = 0; j < kLanes; ++j) {
    const bool inert = j >= coils || open[j] || n[j] == 0;
    pulls_[j] = (coupling == Coupling::kSides && j % 2 == 1) || j >= coils ? 0 : 0.5;
    half_rh_[j] = inert ? 0 : 0.5 * resistance[j] * h;
    if (inert) blocked[j] = true;
    inverse_l_[j] = blocked[j] ? 0 : 1 / (leakage[j] + half_rh_[j]);
    c_[j] = n[j] * inverse_l_[j];
  }
  for (ShortedTurns& s : shorts) {
    // Exponentially fitted: exact for the loop's own decay R/L, stable however stiff.
    const double a = s.resistance * h / s.leakage;
    s.theta = a < 1e-3 ? 0.5 + a / 12 : 1 / -std::expm1(-a) - 1 / a;
  }
}

void StatorLanes::BeginPeriod(double x0, double y0, double x1, double y1, int samples_per_period) {
  x0_ = x0;
  y0_ = y0;
  x1_ = x1;
  y1_ = y1;
  per_period_ = samples_per_period;
  if (coupling == Coupling::kNetwork) return BeginNetwork(x0, y0, x1, y1);
  const GapLaw law{coupling, gap_offset.v, direction_x.v, direction_y.v,
                   n.v,      inverse_l_.v, reluctance};
  Reluctances(law, x0, y0, x1, y1, rel0_.v, rel1_.v, weight_.v, g0_.v, dg_.v);
  for (int j = 0; j < kLanes; ++j) {
    weight_[j] *= pulls_[j];
    sum_[j] = 0;
    start_sq_[j] = phi[j] * phi[j];
  }
}

void StatorLanes::EndPeriod() {
  if (coupling == Coupling::kNetwork) {
    // Trapezoid over the samples.
    const Eigen::Vector2d mean =
        (force_sum_ + 0.5 * (force_start_ - force_end_)) / static_cast<double>(per_period_);
    fx = mean.x(), fy = mean.y();
    return;
  }
  MeanPull({sum_.v, start_sq_.v, phi.v, weight_.v, direction_x.v, direction_y.v}, per_period_, &fx,
           &fy);
}

StatorLoop StatorLanes::LoopOver(const VoltagePattern& pattern, double bus) {
  return {coupling,
          n.v,
          half_rh_.v,
          inverse_l_.v,
          c_.v,
          leakage.v,
          g0_.v,
          dg_.v,
          &pattern,
          bus,
          unipolar ? 0 : -kInfinity,
          lambda.v,
          i.v,
          phi.v,
          sum_.v,
          samples};
}

bool StatorLanes::SomeBlock() const {
  using Flags = std::uint64_t;  // of eight lanes, a byte each
  static_assert(sizeof blocked == sizeof(Flags));
  const Flags present = coils == kLanes ? ~Flags{0} : (Flags{1} << (8 * coils)) - 1;
  return (std::bit_cast<Flags>(blocked) & ~std::bit_cast<Flags>(open) & present) != 0;
}

bool StatorLanes::SomeRunOut() const {
  if (unipolar) return false;
  for (std::size_t j = 0; j < kLanes; ++j)
    if (released[j] && !blocked[j]) return true;
  return false;
}

void StatorLanes::OpenDriven(const VoltagePattern& pattern, double t) {
  if (!SomeBlock()) return;
  for (int j = 0; j < coils; ++j)
    if (blocked[j] && !open[j] && !released[j] &&
        (!unipolar || pattern.gain[SegmentAt(pattern, j, t)][j] > 0))
      Unblock(j);
}

/// Sample by sample with an eye on the sign of the currents.
void StatorLanes::RunChecked(const StatorLoop& loop) {
  blocks_ = false;
  Lane target;
  int k = 0;
  while ((k = RunSamples(loop, k, per_period_, h_, target.v)) < per_period_) {
    // Some diodes block within sample k: take those coils out and solve the sample again.
    blocks_ = true;
    for (int round = 0; round < kLanes; ++round) {
      bool any = false;
      for (int j = 0; j < coils; ++j)
        if (i[j] < 0) {
          Block(j);
          any = true;
        }
      if (!any) break;
      SolveSample(loop, target.v, (k + 1.0) / per_period_);
    }
    for (int j = 0; j < kLanes; ++j) sum_[j] += phi[j] * phi[j];
    ++k;
    if (k < per_period_) OpenDriven(*loop.pattern, k * h_);
  }
}

void StatorLanes::RunPeriods(const PeriodOfBearing* bearings, int count, double bus,
                             int samples_per_period) {
  constexpr int kMost = 8;
  for (; count > kMost; count -= kMost, bearings += kMost)
    RunPeriods(bearings, kMost, bus, samples_per_period);
  StatorLoop loops[kMost];
  StatorLanes* members[kMost];
  int together = 0;
  for (int b = 0; b < count; ++b) {
    const PeriodOfBearing& in = bearings[b];
    StatorLanes& lanes = *in.lanes;
    lanes.OpenDriven(*in.pattern, 0);
    lanes.BeginPeriod(in.x0, in.y0, in.x1, in.y1, samples_per_period);
    loops[together] = lanes.LoopOver(*in.pattern, bus);
    if (lanes.blocks_)
      lanes.RunChecked(loops[together]);
    else
      members[together++] = &lanes;
  }
  const unsigned below =
      together > 0 ? RunTogether(loops, together, samples_per_period, members[0]->h_) : 0;
  for (int m = 0; m < together; ++m)
    if (below >> m & 1U) members[m]->RunChecked(loops[m]);
  for (int b = 0; b < count; ++b) bearings[b].lanes->EndPeriod();
}

void StatorLanes::RunPeriod(const VoltagePattern& pattern, double bus, double x0, double y0,
                            double x1, double y1, int samples_per_period) {
  const PeriodOfBearing one{this, &pattern, x0, y0, x1, y1};
  RunPeriods(&one, 1, bus, samples_per_period);
}

void StatorLanes::Settle(const Lane& currents, double x, double y) {
  // Linear start, then the iron laws' own fixed point at the given currents.
  for (int j = 0; j < kLanes; ++j) {
    i[j] = j < coils && !open[j] ? currents[j] : 0;
    rel_[j] = reluctance.Value(GapAt(j, x, y));
    phi[j] = 0;
  }
  if (coupling == Coupling::kNetwork) SettleNetwork(x, y);
  for (int round = 0; round < RoundsOfSettling(); ++round) {
    Lane g, m, drop, slope;
    double top = 0, sum = 0;
    for (const FluxLaw* law : laws) law->Steady(phi, &drop, &slope);
    for (int j = 0; j < kLanes; ++j) {
      const double mmf =
          coupling == Coupling::kSides ? n[j] * i[j] + n[j ^ 1] * i[j ^ 1] : n[j] * i[j];
      m[j] = mmf - (drop[j] - slope[j] * phi[j]);
      g[j] = 1 / (rel_[j] + slope[j]);
      top += g[j] * m[j];
      sum += g[j];
    }
    const double U = coupling == Coupling::kFloatingRotor ? top / sum : 0;
    double change = 0;
    for (int j = 0; j < kLanes; ++j) {
      const double next = g[j] * (m[j] - U);
      change = std::max(change, std::abs(next - phi[j]));
      phi[j] = next;
    }
    if (change < 1e-16) break;
  }
  for (FluxLaw* law : laws) law->Settle(phi);
  for (int j = 0; j < kLanes; ++j) {
    lambda[j] = n[j] * phi[j] + leakage[j] * i[j];
    blocked[j] = j >= coils || open[j] || n[j] == 0 || (unipolar && i[j] <= 0);
  }
  for (ShortedTurns& s : shorts) {
    s.i = 0;
    s.lambda = s.n * phi[s.coil];
  }
  SetStep(h_);
}

void StatorLanes::Break(int j, double x, double y) {
  open[j] = true;
  blocked[j] = true;
  half_rh_[j] = 0;
  inverse_l_[j] = 0;
  i[j] = 0;
  Refresh(x, y);
  SetStep(h_);
}

void StatorLanes::ShortTurns(int j, double s, double r, double x, double y) {
  // The current of every turn is continuous; leakage scales with turns squared.
  const double turns = n[j], leak = leakage[j], coil_resistance = resistance[j];
  n[j] = (1 - s) * turns;
  leakage[j] = (1 - s) * (1 - s) * leak;
  resistance[j] = (1 - s) * coil_resistance;
  if (std::isfinite(r)) {
    ShortedTurns loop{j, s * turns, s * s * leak, s * coil_resistance + r};
    loop.i = i[j];
    loop.lambda = loop.n * phi[j] + loop.leakage * loop.i;
    shorts.push_back(loop);
  }
  lambda[j] = n[j] * phi[j] + leakage[j] * i[j];
  SetStep(h_);
  Refresh(x, y);
}

void StatorLanes::Force(double x, double y, double* out_x, double* out_y) const {
  *out_x = *out_y = 0;
  if (coupling == Coupling::kNetwork) {
    const Eigen::Vector2d f = PullUnder(PlaceOf(*network, x, y), AmpereTurns());
    *out_x = f.x(), *out_y = f.y();
    return;
  }
  for (int j = 0; j < coils; ++j) {
    if (coupling == Coupling::kSides && j % 2 == 1) continue;
    const double pull = 0.5 * reluctance.Pull(GapAt(j, x, y)) * phi[j] * phi[j];
    *out_x += pull * direction_x[j];
    *out_y += pull * direction_y[j];
  }
}

double StatorLanes::FieldEnergy(double x, double y) const {
  Require(coupling != Coupling::kNetwork, "a stator without magnets, coil by coil");
  double w = 0;
  for (const ShortedTurns& s : shorts) w += 0.5 * s.leakage * s.i * s.i;
  for (int j = 0; j < coils; ++j) {
    w += 0.5 * leakage[j] * i[j] * i[j];
    if (coupling == Coupling::kSides && j % 2 == 1) continue;
    w += 0.5 * reluctance.Value(GapAt(j, x, y)) * phi[j] * phi[j];
  }
  return w;
}

}  // namespace ambrig
