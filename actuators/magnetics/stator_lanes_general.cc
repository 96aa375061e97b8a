/// The general path of the lanes, one sample at a time: iron laws, shorted turns, a moving bus,
/// switching edges anywhere. For ideal iron it gives what the fast path gives.
#include <algorithm>
#include <cmath>

#include "actuators/magnetics/law_loop.h"
#include "actuators/magnetics/stator_lanes.h"
#include "actuators/magnetics/stator_sample.h"
#include "core/base/errors.h"

namespace ambrig {

StatorSample StatorLanes::SampleAt(const VoltagePattern* pattern, double bus, int k) {
  return {coupling,  pattern,  bus, k * h_,     h_,           (k + 1.0) / per_period_,
          rel0_.v,   rel1_.v,  n.v, half_rh_.v, inverse_l_.v, c_.v,
          leakage.v, lambda.v, i.v, phi.v,      sum_.v};
}

void StatorLanes::AddLawTerms(LawTerms* terms) const {
  for (const FluxLaw* law : laws) law->Drop(phi, &terms->drop, &terms->slope);
}

/// Rounds of Newton after the first one.
void StatorLanes::Converge(const StatorSample& sample, const SampleWork& work, LawTerms* terms) {
  for (int round = 1; round < kMostRounds; ++round) {
    AddLawTerms(terms);
    if (NextRound(sample, work, terms)) break;
  }
}

void StatorLanes::SolveGeneral(const StatorSample& sample, SampleWork* work) {
  ShortedWindings shorted;
  const auto inverse = [&](const ShortedTurns& s) {
    return 1 / (s.leakage + s.theta * s.resistance * sample.h);
  };
  for (const ShortedTurns& s : shorts) {
    shorted.mmf[s.coil] += s.n * inverse(s) * s.target;
    shorted.own[s.coil] += s.n * s.n * inverse(s);
  }
  if (coupling == Coupling::kNetwork) {
    ShortedWindings all = shorted;  // and the driven ones
    for (int j = 0; j < coils; ++j) {
      all.mmf[j] += c_[j] * work->target[j];
      all.own[j] += n[j] * c_[j];
    }
    phi = FluxOfSources(now_, all.mmf, all.own);
  } else {
    LawTerms terms;
    AddLawTerms(&terms);
    if (!FirstRoundTo(sample, shorts.empty() ? nullptr : &shorted, &terms, work) && !affine_laws_)
      Converge(sample, *work, &terms);
  }
  ComputeCurrents(sample, work->target);
  for (ShortedTurns& s : shorts) s.i = inverse(s) * (s.target - s.n * phi[s.coil]);
}

void StatorLanes::Refresh(double x, double y) {
  // Same as a solve with no voltage and no time: currents that carry the present linkages.
  if (coupling == Coupling::kNetwork) now_ = PlaceOf(*network, x, y);
  for (int j = 0; j < kLanes; ++j) rel_[j] = reluctance.Value(GapAt(j, x, y));
  const Lane keep_half = half_rh_, keep_inverse = inverse_l_;
  for (int j = 0; j < kLanes; ++j) {
    half_rh_[j] = 0;
    inverse_l_[j] = blocked[j] ? 0 : 1 / leakage[j];
    c_[j] = n[j] * inverse_l_[j];
  }
  for (ShortedTurns& s : shorts) s.target = s.lambda;
  SampleWork work;
  work.target = lambda;
  StatorSample sample = SampleAt(nullptr, 0, 0);
  sample.rel0 = sample.rel1 = rel_.v;
  sample.h = 0;
  SolveGeneral(sample, &work);
  half_rh_ = keep_half;
  inverse_l_ = keep_inverse;
  for (int j = 0; j < kLanes; ++j) {
    c_[j] = n[j] * inverse_l_[j];
    if (blocked[j]) i[j] = 0;
    lambda[j] = n[j] * phi[j] + leakage[j] * i[j];
  }
}

void StatorLanes::StepCurrents(const Lane& currents) {
  Require(coupling != Coupling::kNetwork && shorts.empty(), "a circuit of lanes, coil by coil");
  for (int j = 0; j < kLanes; ++j) i[j] = j < coils && !open[j] ? currents[j] : 0;
  SampleWork work;
  for (int j = 0; j < kLanes; ++j)
    work.mmf[j] = n[j] * i[j] + (coupling == Coupling::kSides ? n[j ^ 1] * i[j ^ 1] : 0);
  work.stiffness = rel_;
  LawTerms terms;
  AddLawTerms(&terms);
  const StatorSample sample = SampleAt(nullptr, 0, 0);
  if (!NextRound(sample, work, &terms) && !affine_laws_) Converge(sample, work, &terms);
  for (int j = 0; j < kLanes; ++j) lambda[j] = n[j] * phi[j] + leakage[j] * i[j];
  for (FluxLaw* law : laws) law->Commit(phi);
}

void StatorLanes::UnblockDriven(const VoltagePattern& p, double bus, double t, Lane* target) {
  // A blocked coil is an open circuit until its switches close: only what follows counts.
  for (int j = 0; j < coils; ++j) {
    if (!blocked[j] || open[j] || released[j]) continue;
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

/// A sample in which no current comes to its floor. false: one does, and nothing but the
/// fluxes has changed.
bool StatorLanes::StepDriven(const StatorSample& sample) {
  SampleWork work;
  LawTerms terms;
  Clear(&terms);
  AddLawTerms(&terms);
  if (!FirstRound(sample, &terms, &work) && !affine_laws_) Converge(sample, work, &terms);
  return FinishSample(sample, work.target, unipolar ? 0 : -kInfinity);
}

/// A sample in which diodes may block and switches connect coils again; with shorted turns, or
/// of any stator.
void StatorLanes::StepWithDiodes(const StatorSample& sample) {
  if (coupling == Coupling::kNetwork) PlaceNetwork(sample.fraction);
  SampleWork work;
  ComputeTargets(sample, &work.target);
  UnblockDriven(*sample.pattern, sample.bus, sample.t, &work.target);
  for (ShortedTurns& s : shorts) s.target = s.lambda - (1 - s.theta) * s.resistance * h_ * s.i;
  for (int round = 0; round <= kLanes; ++round) {
    SolveGeneral(sample, &work);
    bool any = false;
    for (int j = 0; j < coils; ++j) {
      // A released coil sees a voltage against its current: where both have one sign, the
      // current has ended.
      const bool ended = unipolar ? i[j] < 0 : released[j] && i[j] * sample.pattern->gain[2][j] > 0;
      if (!ended) continue;
      Block(j);
      any = true;
    }
    if (!any) break;
  }
  TakeSample(sample);
  if (coupling == Coupling::kNetwork) TakeNetwork();
  for (ShortedTurns& s : shorts) s.lambda = s.n * phi[s.coil] + s.leakage * s.i;
}

void StatorLanes::StepSample(const VoltagePattern& pattern, double bus, int k) {
  samples[k] = i;
  const StatorSample sample = SampleAt(&pattern, bus, k);
  if (coupling == Coupling::kNetwork || !shorts.empty() || SomeBlock() || SomeRunOut() ||
      !StepDriven(sample))
    StepWithDiodes(sample);
  for (FluxLaw* law : laws) law->Commit(phi);
}

void StatorLanes::RunGeneralPeriod(const VoltagePattern& pattern, double bus, double x0, double y0,
                                   double x1, double y1, int samples_per_period) {
  BeginPeriod(x0, y0, x1, y1, samples_per_period);
  bool one_law = laws.size() == 1 && shorts.empty() && coupling != Coupling::kNetwork;
  for (int j = 0; j < coils; ++j)
    one_law = one_law && pattern.t1[j] <= pattern.t2[j];  // else the second edge is none
  for (int k = 0; k < per_period_; ++k) {
    if (one_law && !SomeBlock() && !SomeRunOut())
      k = laws[0]->RunSamples({LoopOver(pattern, bus), rel0_.v, rel1_.v, h_}, k, per_period_);
    if (k < per_period_) StepSample(pattern, bus, k);
  }
  EndPeriod();
}

double StatorLanes::BusCurrent(const VoltagePattern& pattern, int k) const {
  return DrawnFromBus(pattern, k * h_, h_, samples[k], i);
}

}  // namespace ambrig
