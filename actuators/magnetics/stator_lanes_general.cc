/// The general path of the lanes, one sample at a time: iron laws, shorted turns, a moving bus,
/// switching edges anywhere. For ideal iron it gives what the fast path gives.
#include <algorithm>
#include <cmath>

#include "actuators/magnetics/lane_vector.h"
#include "actuators/magnetics/stator_lanes.h"
#include "core/base/errors.h"

namespace ambrig {

namespace {

using V = LaneVector;

constexpr int kMostRounds = 30;  // Newton over the iron laws
// [-] change of a round; what is left after it goes with its square
constexpr double kConverged = 1e-5;

/// Time from the start of the sample to a switching edge, within [0, h].
[[gnu::always_inline]] inline V Within(const V& edge, double t, double h) {
  return Min(Max(edge - t, 0.0), h);
}

struct Edges {
  const VoltagePattern* pattern;
  double bus, t, h;
};

// Everything that a wide load reads soon after is written by a wide store: narrow stores before
// a wide load would cost more than the arithmetic.

/// λ* = λ + ∫v dt - (R h/2) i
AMBRIG_WIDE void Targets(const Edges& e, const double* lambda, const double* half_rh,
                         const double* i, double* target) {
  const VoltagePattern& p = *e.pattern;
  const V a = Within(Load(p.t1.v), e.t, e.h), b0 = Within(Load(p.t2.v), e.t, e.h);
  const V b = Max(b0, a);
  const V v0 = Load(p.gain[0].v) * e.bus + Load(p.drop[0].v);
  const V v1 = Load(p.gain[1].v) * e.bus + Load(p.drop[1].v);
  const V v2 = Load(p.gain[2].v) * e.bus + Load(p.drop[2].v);
  Store(target,
        Load(lambda) + ((v2 * e.h + (v1 - v2) * b) + (v0 - v1) * a) - Load(half_rh) * Load(i));
}

/// Mean current drawn from the bus: ∫ gain i dt / h with i linear over the sample.
AMBRIG_WIDE double Drawn(const Edges& e, const double* before, const double* after) {
  const VoltagePattern& p = *e.pattern;
  const V a = Within(Load(p.t1.v), e.t, e.h), b0 = Within(Load(p.t2.v), e.t, e.h);
  const V b = Max(b0, a);
  const double per = 1 / e.h;
  const V i0 = Load(before), rise = (Load(after) - i0) * (0.5 * per);
  const V at_a = a * per * (i0 + rise * a), at_b = b * per * (i0 + rise * b),
          at_h = i0 + rise * e.h;
  const V g1 = Load(p.gain[1].v), g2 = Load(p.gain[2].v);
  return Sum(Load(p.gain[0].v) * at_a + g1 * (at_b - at_a) + g2 * (at_h - at_b));
}

/// Reluctance at a fraction of the period.
AMBRIG_WIDE void Reluctance(const double* rel0, const double* rel1, double fraction, double* rel) {
  const V r0 = Load(rel0);
  Store(rel, r0 + (Load(rel1) - r0) * fraction);
}

/// MMF Σ c λ* and stiffness 1/P + Σ n c of the driven windings, over both of a shared core, to
/// which shorted turns add theirs.
AMBRIG_WIDE void Windings(Coupling coupling, const double* c, const double* n, const double* target,
                          const double* rel, const double* short_mmf, const double* short_own,
                          double* mmf, double* stiffness) {
  V m = Load(c) * Load(target), w = Load(n) * Load(c);
  if (short_mmf) {
    m += Load(short_mmf);
    w += Load(short_own);
  }
  if (coupling == Coupling::kSides) {
    m = m + Partner(m);
    w = w + Partner(w);
  }
  Store(mmf, m);
  Store(stiffness, Load(rel) + w);
}

AMBRIG_WIDE void Clear(double* drop, double* slope) {
  const V zero = {};
  Store(drop, zero);
  Store(slope, zero);
}

/// One round of Newton: φ from MMF, reluctance and the iron's tangent. Returns whether it changed
/// the fluxes by less than kConverged of their size.
AMBRIG_WIDE bool Round(Coupling coupling, const double* mmf, const double* stiffness,
                       const double* drop, const double* slope, double* phi) {
  const V old = Load(phi), s = Load(slope);
  const V m = Load(mmf) - (Load(drop) - s * old);
  const V g = 1.0 / (Load(stiffness) + s);
  V next = g * m;
  if (coupling == Coupling::kFloatingRotor) next = next - g * (Sum(next) / Sum(g));
  Store(phi, next);
  const V change = next - old;
  return Sum(change * change) <= kConverged * kConverged * Sum(next * next) + 1e-36;
}

AMBRIG_WIDE void Currents(const double* inverse_l, const double* n, const double* target,
                          const double* phi, double* i) {
  Store(i, Load(inverse_l) * (Load(target) - Load(n) * Load(phi)));
}

AMBRIG_WIDE void Take(const double* n, const double* leakage, const double* phi, const double* i,
                      double* lambda, double* sum) {
  const V p = Load(phi);
  Store(lambda, Load(n) * p + Load(leakage) * Load(i));
  Store(sum, Load(sum) + p * p);
}

}  // namespace

void StatorLanes::SolveGeneral(const Lane& target, double h) {
  if (coupling == Coupling::kNetwork) return SolveNetwork(target, h);
  Lane short_mmf, short_own;
  const auto inverse = [h](const ShortedTurns& s) {
    return 1 / (s.leakage + s.theta * s.resistance * h);
  };
  for (const ShortedTurns& s : shorts) {
    short_mmf[s.coil] += s.n * inverse(s) * s.target;
    short_own[s.coil] += s.n * s.n * inverse(s);
  }
  Lane mmf, stiffness, drop, slope;
  Windings(coupling, c_.v, n.v, target.v, rel_.v, shorts.empty() ? nullptr : short_mmf.v,
           short_own.v, mmf.v, stiffness.v);
  const int rounds = affine_laws_ ? 1 : kMostRounds;
  for (int round = 0; round < rounds; ++round) {
    Clear(drop.v, slope.v);
    for (const FluxLaw* law : laws) law->Drop(phi, &drop, &slope);
    if (Round(coupling, mmf.v, stiffness.v, drop.v, slope.v, phi.v)) break;
  }
  Currents(inverse_l_.v, n.v, target.v, phi.v, i.v);
  for (ShortedTurns& s : shorts) s.i = inverse(s) * (s.target - s.n * phi[s.coil]);
}

void StatorLanes::StepCurrents(const Lane& currents) {
  Require(coupling != Coupling::kNetwork && shorts.empty(), "a circuit of lanes, coil by coil");
  Lane mmf, drop, slope;
  for (int j = 0; j < kLanes; ++j) i[j] = j < coils && !open[j] ? currents[j] : 0;
  for (int j = 0; j < kLanes; ++j)
    mmf[j] = n[j] * i[j] + (coupling == Coupling::kSides ? n[j ^ 1] * i[j ^ 1] : 0);
  for (int round = 0; round < (affine_laws_ ? 1 : kMostRounds); ++round) {
    Clear(drop.v, slope.v);
    for (const FluxLaw* law : laws) law->Drop(phi, &drop, &slope);
    if (Round(coupling, mmf.v, rel_.v, drop.v, slope.v, phi.v)) break;
  }
  for (int j = 0; j < kLanes; ++j) lambda[j] = n[j] * phi[j] + leakage[j] * i[j];
  for (FluxLaw* law : laws) law->Commit(phi);
}

void StatorLanes::UnblockDriven(const VoltagePattern& p, double bus, double t, Lane* target) {
  // A blocked coil is an open circuit until its switches close: only what follows counts.
  for (int j = 0; j < coils; ++j) {
    if (!blocked[j] || open[j]) continue;
    const double edge[4] = {t, p.t1[j], std::max(p.t1[j], p.t2[j]), t + h_};
    double volt_seconds = 0;
    for (int q = 0; q < 3; ++q) {
      const double span = std::min(edge[q + 1], t + h_) - std::max(edge[q], t);
      if (span <= 0) continue;
      if (blocked[j] && (!unipolar || p.gain[q][j] > 0)) Unblock(j);
      if (!blocked[j]) volt_seconds += span * (p.gain[q][j] * bus + p.drop[q][j]);
    }
    (*target)[j] = lambda[j] + volt_seconds - half_rh_[j] * i[j];
  }
}

void StatorLanes::StepSample(const VoltagePattern& pattern, double bus, int k) {
  const double fraction = (k + 1.0) / per_period_;
  const Edges edges{&pattern, bus, k * h_, h_};
  samples[k] = i;
  const Lane& start = samples[k];
  if (coupling == Coupling::kNetwork)
    PlaceNetwork(fraction);
  else
    Reluctance(rel0_.v, rel1_.v, fraction, rel_.v);
  Lane target;
  Targets(edges, lambda.v, half_rh_.v, i.v, target.v);
  UnblockDriven(pattern, bus, edges.t, &target);
  for (ShortedTurns& s : shorts) s.target = s.lambda - (1 - s.theta) * s.resistance * h_ * s.i;
  for (int round = 0; round <= kLanes; ++round) {
    SolveGeneral(target, h_);
    bool any = false;
    for (int j = 0; unipolar && j < coils; ++j)
      if (i[j] < 0) {
        Block(j);
        any = true;
      }
    if (!any) break;
  }
  if (coupling == Coupling::kNetwork)
    TakeNetwork();
  else
    Take(n.v, leakage.v, phi.v, i.v, lambda.v, sum_.v);
  for (ShortedTurns& s : shorts) s.lambda = s.n * phi[s.coil] + s.leakage * s.i;
  for (FluxLaw* law : laws) law->Commit(phi);
  bus_current_ = Drawn(edges, start.v, i.v);
}

}  // namespace ambrig
