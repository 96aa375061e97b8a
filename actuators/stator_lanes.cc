#include "actuators/stator_lanes.h"

#include <algorithm>
#include <cmath>

#include "actuators/lane_vector.h"
#include "core/base/errors.h"

namespace ambrig {

namespace {

using V = LaneVector;

/// What one sample's update reads and writes; pointers into a StatorLanes.
struct Kernel {
  const double *n, *c, *inverse_l, *half_rh, *leakage, *g0, *dg;
  double *lambda, *i, *phi, *sum;
};

/// One period's pattern, ready for the loop: volt-seconds of a sample from its two edges.
struct Edges {
  const double *t1, *t2, *v;  // v: three voltages, eight lanes each
  double h;
};

/// Flux that carries the targets λ*; `inverse_sum` is 1/Σg (radial only).
template <Coupling kCoupling>
[[gnu::always_inline]] inline V Flux(const V& g, const V& m, double inverse_sum) {
  const V gm = g * m;
  if constexpr (kCoupling == Coupling::kFloatingRotor) {
    return gm - g * (Sum(gm) * inverse_sum);
  } else if constexpr (kCoupling == Coupling::kSides) {
    return g * (m + Partner(m));
  } else {
    return gm;
  }
}

/// Runs samples from k while nothing needs attention; returns the index of the sample whose
/// solution has a negative current (its targets are left in `target`), or `count`.
template <Coupling kCoupling>
[[gnu::always_inline]] inline int Run(const Kernel& s, const Edges& e, int k, int count, double floor,
                                      Lane* samples, double* target) {
  const V n = Load(s.n), c = Load(s.c), inverse_l = Load(s.inverse_l), half_rh = Load(s.half_rh);
  const V leakage = Load(s.leakage), g0 = Load(s.g0), dg = Load(s.dg);
  const V t1 = Load(e.t1), t2 = Load(e.t2);
  const V v2h = Load(e.v + 2 * kLanes) * e.h;
  const V step1 = Load(e.v) - Load(e.v + kLanes), step2 = Load(e.v + kLanes) - Load(e.v + 2 * kLanes);
  const V zero = {}, h = zero + e.h;
  V lambda = Load(s.lambda), i = Load(s.i), phi = Load(s.phi), sum = Load(s.sum);
  const double per = 1.0 / count;
  for (; k < count; ++k) {
    Store(samples[k].v, i);
    const double t = k * e.h;
    V a = t1 - t, b = t2 - t;
    a = a < zero ? zero : a;
    a = a > h ? h : a;
    b = b < zero ? zero : b;
    b = b > h ? h : b;
    const V wanted = lambda + ((v2h + step2 * b) + step1 * a) - half_rh * i;
    const V g = g0 + dg * ((k + 1) * per);
    phi = Flux<kCoupling>(g, c * wanted, kCoupling == Coupling::kFloatingRotor ? 1 / Sum(g) : 0);
    i = inverse_l * (wanted - n * phi);
    lambda = n * phi + leakage * i;
    double least = 0;
    for (int j = 0; j < kLanes; ++j) least = i[j] < least ? i[j] : least;
    if (least < floor) {
      Store(target, wanted);
      break;
    }
    sum += phi * phi;
  }
  Store(s.lambda, lambda);
  Store(s.i, i);
  Store(s.phi, phi);
  Store(s.sum, sum);
  return k;
}

AMBRIG_WIDE int RunRadial(const Kernel& s, const Edges& e, int k, int count, double floor, Lane* samples,
                          double* target) {
  return Run<Coupling::kFloatingRotor>(s, e, k, count, floor, samples, target);
}
AMBRIG_WIDE int RunSides(const Kernel& s, const Edges& e, int k, int count, double floor, Lane* samples,
                         double* target) {
  return Run<Coupling::kSides>(s, e, k, count, floor, samples, target);
}
AMBRIG_WIDE int RunSeparate(const Kernel& s, const Edges& e, int k, int count, double floor, Lane* samples,
                            double* target) {
  return Run<Coupling::kNone>(s, e, k, count, floor, samples, target);
}

/// The same solution for one sample, after coils were taken out of it.
template <Coupling kCoupling>
void SolveOnce(const Kernel& s, const double* target, double fraction) {
  const V g = Load(s.g0) + Load(s.dg) * fraction, wanted = Load(target);
  const V phi = Flux<kCoupling>(g, Load(s.c) * wanted, 1 / Sum(g));
  const V i = Load(s.inverse_l) * (wanted - Load(s.n) * phi);
  Store(s.phi, phi);
  Store(s.i, i);
  Store(s.lambda, Load(s.n) * phi + Load(s.leakage) * i);
}

void SolveOnce(Coupling coupling, const Kernel& s, const double* target, double fraction) {
  switch (coupling) {
    case Coupling::kFloatingRotor: return SolveOnce<Coupling::kFloatingRotor>(s, target, fraction);
    case Coupling::kSides: return SolveOnce<Coupling::kSides>(s, target, fraction);
    case Coupling::kNone: return SolveOnce<Coupling::kNone>(s, target, fraction);
  }
}

/// Whether the switches of lane j are closed at time t of the period, and where the pattern stands.
int SegmentAt(const VoltagePattern& p, int j, double t) { return t < p.t1[j] ? 0 : (t < p.t2[j] ? 1 : 2); }

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
  any_short = false;
  affine_laws_ = true;
  for (FluxLaw* law : laws) {
    law->SetStep(h);
    affine_laws_ = affine_laws_ && law->linear();
  }
  for (int j = 0; j < kLanes; ++j) {
    const bool inert = j >= coils || open[j] || n[j] == 0;
    half_rh_[j] = inert ? 0 : 0.5 * resistance[j] * h;
    if (inert) blocked[j] = true;
    inverse_l_[j] = blocked[j] ? 0 : 1 / (leakage[j] + half_rh_[j]);
    c_[j] = n[j] * inverse_l_[j];
    if (n2[j] != 0) {
      any_short = true;
      // Exponentially fitted: exact for the loop's own decay R/L, stable however stiff.
      const double a = resistance2[j] * h / leakage2[j];
      theta2_[j] = a < 1e-3 ? 0.5 + a / 12 : 1 / -std::expm1(-a) - 1 / a;
    }
  }
}

void StatorLanes::BeginPeriod(double x0, double y0, double x1, double y1, int samples_per_period) {
  x0_ = x0;
  y0_ = y0;
  x1_ = x1;
  y1_ = y1;
  per_period_ = samples_per_period;
  for (int j = 0; j < kLanes; ++j) {
    rel0_[j] = reluctance.Value(GapAt(j, x0, y0));
    rel1_[j] = reluctance.Value(GapAt(j, x1, y1));
    const double slope = reluctance.Slope(0.5 * (GapAt(j, x0, y0) + GapAt(j, x1, y1)));
    weight_[j] = (coupling == Coupling::kSides && j % 2 == 1) || j >= coils ? 0 : 0.5 * slope;
    sum_[j] = 0;
    start_sq_[j] = phi[j] * phi[j];
  }
  for (int j = 0; j < kLanes; ++j) UpdateConductance(j);
}

void StatorLanes::EndPeriod() {
  // Trapezoid over the samples: half of the first and of the last.
  fx = fy = 0;
  for (int j = 0; j < kLanes; ++j) {
    const double mean = (sum_[j] + 0.5 * (start_sq_[j] - phi[j] * phi[j])) / per_period_;
    fx += weight_[j] * direction_x[j] * mean;
    fy += weight_[j] * direction_y[j] * mean;
  }
}

void StatorLanes::RunPeriod(const VoltagePattern& pattern, double bus, double x0, double y0, double x1,
                            double y1, int samples_per_period) {
  BeginPeriod(x0, y0, x1, y1, samples_per_period);
  alignas(64) double v[3 * kLanes];
  for (int q = 0; q < 3; ++q)
    for (int j = 0; j < kLanes; ++j) v[q * kLanes + j] = pattern.gain[q][j] * bus + pattern.drop[q][j];
  const Kernel s{n.v, c_.v, inverse_l_.v, half_rh_.v, leakage.v, g0_.v, dg_.v, lambda.v, i.v, phi.v, sum_.v};
  const auto run = coupling == Coupling::kFloatingRotor ? RunRadial
                   : coupling == Coupling::kSides       ? RunSides
                                                        : RunSeparate;
  const double floor = unipolar ? 0 : -kInfinity;
  const auto unblock_driven = [&](double t) {
    for (int j = 0; j < coils; ++j)
      if (blocked[j] && !open[j] && (!unipolar || pattern.gain[SegmentAt(pattern, j, t)][j] > 0)) Unblock(j);
  };
  unblock_driven(0);
  Lane target;
  int k = 0;
  const Edges edges{pattern.t1.v, pattern.t2.v, v, h_};
  while ((k = run(s, edges, k, per_period_, floor, samples, target.v)) < per_period_) {
    // Some diodes block within sample k: take those coils out and solve the sample again.
    for (int round = 0; round < kLanes; ++round) {
      bool any = false;
      for (int j = 0; j < coils; ++j)
        if (i[j] < 0) {
          Block(j);
          any = true;
        }
      if (!any) break;
      SolveOnce(coupling, s, target.v, (k + 1.0) / per_period_);
    }
    for (int j = 0; j < kLanes; ++j) sum_[j] += phi[j] * phi[j];
    ++k;
    if (k < per_period_) unblock_driven(k * h_);
  }
  EndPeriod();
}

void StatorLanes::Refresh(double x, double y) {
  // Same as a solve with no voltage and no time: currents that carry the present linkages.
  const double h = h_;
  for (int j = 0; j < kLanes; ++j) rel_[j] = reluctance.Value(GapAt(j, x, y));
  const Lane keep_half = half_rh_, keep_resistance2 = resistance2, keep_inverse = inverse_l_;
  for (int j = 0; j < kLanes; ++j) {
    half_rh_[j] = 0;
    resistance2[j] = 0;
    inverse_l_[j] = blocked[j] ? 0 : 1 / leakage[j];
    c_[j] = n[j] * inverse_l_[j];
  }
  SolveGeneral(lambda, lambda2);
  half_rh_ = keep_half;
  resistance2 = keep_resistance2;
  inverse_l_ = keep_inverse;
  for (int j = 0; j < kLanes; ++j) {
    c_[j] = n[j] * inverse_l_[j];
    if (blocked[j]) i[j] = 0;
    lambda[j] = n[j] * phi[j] + leakage[j] * i[j];
  }
  h_ = h;
}

void StatorLanes::Settle(const Lane& currents, double x, double y) {
  // Linear start, then the iron laws' own fixed point at the given currents.
  for (int j = 0; j < kLanes; ++j) {
    i[j] = j < coils && !open[j] ? currents[j] : 0;
    i2[j] = 0;
    rel_[j] = reluctance.Value(GapAt(j, x, y));
    phi[j] = 0;
  }
  for (int round = 0; round < (laws.empty() ? 1 : 200); ++round) {
    Lane g, m, drop, slope;
    double top = 0, sum = 0;
    for (const FluxLaw* law : laws) law->Steady(phi, &drop, &slope);
    for (int j = 0; j < kLanes; ++j) {
      const double mmf = coupling == Coupling::kSides ? n[j] * i[j] + n[j ^ 1] * i[j ^ 1] : n[j] * i[j];
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
    lambda2[j] = n2[j] * phi[j];
    blocked[j] = j >= coils || open[j] || n[j] == 0 || (unipolar && i[j] <= 0);
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
    n2[j] = s * turns;
    leakage2[j] = s * s * leak;
    resistance2[j] = s * coil_resistance + r;
    i2[j] = i[j];
    lambda2[j] = n2[j] * phi[j] + leakage2[j] * i2[j];
  }
  lambda[j] = n[j] * phi[j] + leakage[j] * i[j];
  SetStep(h_);
  Refresh(x, y);
}

void StatorLanes::Force(double x, double y, double* out_x, double* out_y) const {
  *out_x = *out_y = 0;
  for (int j = 0; j < coils; ++j) {
    if (coupling == Coupling::kSides && j % 2 == 1) continue;
    const double pull = 0.5 * reluctance.Slope(GapAt(j, x, y)) * phi[j] * phi[j];
    *out_x += pull * direction_x[j];
    *out_y += pull * direction_y[j];
  }
}

double StatorLanes::FieldEnergy(double x, double y) const {
  double w = 0;
  for (int j = 0; j < coils; ++j) {
    w += 0.5 * leakage[j] * i[j] * i[j];
    if (n2[j] != 0) w += 0.5 * leakage2[j] * i2[j] * i2[j];
    if (coupling == Coupling::kSides && j % 2 == 1) continue;
    w += 0.5 * reluctance.Value(GapAt(j, x, y)) * phi[j] * phi[j];
  }
  return w;
}

}  // namespace ambrig
