#include "actuators/magnetics/stator_sample.h"

#include "actuators/magnetics/law_loop.h"

namespace ambrig {

namespace {

using V = LaneVector;

/// Time from the start of the sample to a switching edge, within [0, h].
[[gnu::always_inline]] inline V Within(const V& edge, double t, double h) {
  return Min(Max(edge - t, 0.0), h);
}

/// λ* = λ + ∫v dt - (R h/2) i
[[gnu::always_inline]] inline V TargetOf(const StatorSample& s) {
  const VoltagePattern& p = *s.pattern;
  const V a = Within(Load(p.t1.v), s.t, s.h), b = Max(Within(Load(p.t2.v), s.t, s.h), a);
  const V v0 = Load(p.gain[0].v) * s.bus + Load(p.drop[0].v);
  const V v1 = Load(p.gain[1].v) * s.bus + Load(p.drop[1].v);
  const V v2 = Load(p.gain[2].v) * s.bus + Load(p.drop[2].v);
  return Load(s.lambda) + ((v2 * s.h + (v1 - v2) * b) + (v0 - v1) * a) -
         Load(s.half_rh) * Load(s.i);
}

[[gnu::always_inline]] inline void ClearTerms(LawTerms* terms) {
  const V zero = {};
  Store(terms->drop.v, zero);
  Store(terms->slope.v, zero);
}

/// φ from MMF, stiffness and the iron's tangent. Whether it changed by less than kConverged
/// of its size.
[[gnu::always_inline]] inline bool Round(const StatorSample& s, const V& mmf, const V& stiffness,
                                         LawTerms* terms) {
  const V old = Load(s.phi), slope = Load(terms->slope.v);
  const V g = 1.0 / (stiffness + slope);
  V next = g * (mmf - (Load(terms->drop.v) - slope * old));
  if (s.coupling == Coupling::kFloatingRotor) next = next - g * (CommonSum(next) * (1 / Sum(g)));
  Store(s.phi, next);
  ClearTerms(terms);
  return IsSmall(V(next - old), next, kConverged);
}

/// MMF and stiffness for `target`, kept in `work`, and the first round.
[[gnu::always_inline]] inline bool Begin(const StatorSample& s, const V& target,
                                         const ShortedWindings* shorted, LawTerms* terms,
                                         SampleWork* work) {
  const V c = Load(s.c), r0 = Load(s.rel0);
  V mmf = c * target, own = Load(s.n) * c;
  if (shorted) {
    mmf += Load(shorted->mmf.v);
    own += Load(shorted->own.v);
  }
  if (s.coupling == Coupling::kSides) {
    mmf = mmf + Partner(mmf);
    own = own + Partner(own);
  }
  const V stiffness = r0 + (Load(s.rel1) - r0) * s.fraction + own;
  Store(work->mmf.v, mmf);
  Store(work->stiffness.v, stiffness);
  return Round(s, mmf, stiffness, terms);
}

}  // namespace

AMBRIG_WIDE void Clear(LawTerms* terms) { ClearTerms(terms); }

AMBRIG_WIDE void ComputeTargets(const StatorSample& s, Lane* target) {
  Store(target->v, TargetOf(s));
}

AMBRIG_WIDE bool FirstRound(const StatorSample& s, LawTerms* terms, SampleWork* work) {
  const V target = TargetOf(s);
  Store(work->target.v, target);
  return Begin(s, target, nullptr, terms, work);
}

AMBRIG_WIDE bool FirstRoundTo(const StatorSample& s, const ShortedWindings* shorted,
                              LawTerms* terms, SampleWork* work) {
  return Begin(s, Load(work->target.v), shorted, terms, work);
}

AMBRIG_WIDE bool NextRound(const StatorSample& s, const SampleWork& work, LawTerms* terms) {
  return Round(s, Load(work.mmf.v), Load(work.stiffness.v), terms);
}

AMBRIG_WIDE void ComputeCurrents(const StatorSample& s, const Lane& target) {
  Store(s.i, Load(s.inverse_l) * (Load(target.v) - Load(s.n) * Load(s.phi)));
}

AMBRIG_WIDE void TakeSample(const StatorSample& s) {
  const V phi = Load(s.phi);
  Store(s.lambda, Load(s.n) * phi + Load(s.leakage) * Load(s.i));
  Store(s.sum, Load(s.sum) + phi * phi);
}

AMBRIG_WIDE bool FinishSample(const StatorSample& s, const Lane& target, double floor) {
  const V phi = Load(s.phi), linked = Load(s.n) * phi;
  const V i = Load(s.inverse_l) * (Load(target.v) - linked);
  if (-Largest(-i) < floor) return false;
  Store(s.i, i);
  Store(s.lambda, linked + Load(s.leakage) * i);
  Store(s.sum, Load(s.sum) + phi * phi);
  return true;
}

AMBRIG_WIDE double DrawnFromBus(const VoltagePattern& p, double t, double h, const Lane& before,
                                const Lane& after) {
  const V a = Within(Load(p.t1.v), t, h), b = Max(Within(Load(p.t2.v), t, h), a);
  const double per = 1 / h;
  const V i0 = Load(before.v), rise = (Load(after.v) - i0) * (0.5 * per);
  const V at_a = a * per * (i0 + rise * a), at_b = b * per * (i0 + rise * b), at_h = i0 + rise * h;
  const V g1 = Load(p.gain[1].v), g2 = Load(p.gain[2].v);
  return Sum(Load(p.gain[0].v) * at_a + g1 * (at_b - at_a) + g2 * (at_h - at_b));
}

}  // namespace ambrig
