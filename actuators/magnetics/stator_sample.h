#pragma once
/// One sample of a bearing's circuit in the general path, its steps in lanes: targets λ*, rounds of
/// Newton over the iron laws, currents and linkages. Equations: stator_lanes.h. Pointers are to
/// eight lanes each.
///
/// Everything that a wide load reads soon after is written by a wide store: narrow stores before a
/// wide load would cost more than the arithmetic.
#include "actuators/magnetics/coupling.h"
#include "actuators/magnetics/stator_loop.h"

namespace ambrig {

/// A sample of h [s] that starts t [s] after the period's start and ends at this fraction
/// of the period.
struct StatorSample {
  Coupling coupling = Coupling::kFloatingRotor;
  const VoltagePattern* pattern;
  double bus, t, h, fraction;  // [V], [s], [s], [-]
  // reluctance at both ends of the period; signed turns, R h/2, 1/(L_l + R h/2) and n times it, L_l
  const double *rel0, *rel1, *n, *half_rh, *inverse_l, *c, *leakage;
  double *lambda, *i, *phi, *sum;  // state, and Σφ² of the samples' ends
};

/// What the iron laws add at some flux: MMF drops [A] and their slopes [A/Wb].
struct LawTerms {
  Lane drop, slope;
};
void Clear(LawTerms* terms);

/// What the rounds of a sample share: λ*, MMF Σ c λ* and stiffness 1/P + Σ n c of
/// the driven windings.
struct SampleWork {
  Lane target, mmf, stiffness;
};
/// MMF and stiffness that loops of shorted turns add to those of their coils.
struct ShortedWindings {
  Lane mmf, own;
};

void ComputeTargets(const StatorSample& s, Lane* target);
/// Prepares `work` and takes the first round of Newton from the terms at the present flux; clears
/// them. Returns whether the fluxes have converged.
bool FirstRound(const StatorSample& s, LawTerms* terms, SampleWork* work);
/// The same to targets that stand in `work`, with the loops of shorted turns; null: there are none.
bool FirstRoundTo(const StatorSample& s, const ShortedWindings* shorted, LawTerms* terms,
                  SampleWork* work);
/// One more round from the terms at the present flux; clears them.
bool NextRound(const StatorSample& s, const SampleWork& work, LawTerms* terms);

void ComputeCurrents(const StatorSample& s, const Lane& target);
/// Linkages of these currents and fluxes; the sample's φ² is added up.
void TakeSample(const StatorSample& s);
/// Both at once. false where a current falls below `floor` [A]: nothing is changed then.
bool FinishSample(const StatorSample& s, const Lane& target, double floor);

/// Mean current drawn from the bus over a sample, whose currents run linearly from
/// `before` to `after` [A].
double DrawnFromBus(const VoltagePattern& pattern, double t, double h, const Lane& before,
                    const Lane& after);

}  // namespace ambrig
