#pragma once
/// The samples of a period of a bearing with one iron law, in registers: what the general path does
/// sample by sample (stator_lanes_general.cc), for a law that gives its terms in lanes. Only for
/// sources that hold such a law.
///
/// A law's kernel is a template of the vector (whole_lane_vector.h) over the law's state:
///
///   explicit Kernel(const State&);                      what it needs of the state, in registers
///   void Terms(V phi, V* drop, V* slope) const;         [A], [A/Wb] if the flux is phi [Wb] at
///                                                       the end of the step
///   void Commit(V phi);                                 the step is taken
///   void Keep(State*) const;                            back to the state
///   static constexpr bool kLinear;                      Terms is linear in the flux: then it has
///   V Base() const; double Slope() const;               drop = base + slope phi
///
/// AMBRIG_LAW_LANES(Name) makes of NameKernel and NameState the functions NameDrop and NameLoop,
/// which the members of a FluxLaw call.
#include "actuators/magnetics/flux_law.h"
#include "actuators/magnetics/running_stator.h"

namespace ambrig {

/// What the kernels of laws without memory share.
template <class V, class Law>
struct MemorylessKernel {
  static constexpr bool kLinear = false;
  Law law;
  [[gnu::always_inline]] explicit MemorylessKernel(const Law& of) : law(of) {}
  [[gnu::always_inline]] void Commit(const V& /*phi*/) {}
  [[gnu::always_inline]] void Keep(Law* /*law*/) const {}
};

inline constexpr int kMostRounds = 30;  // Newton over the iron laws
// [-] change of a round; what is left after it goes with its square
inline constexpr double kConverged = 1e-5;
// [-] the same of a correction with the tangent of the step's start; what is left after it is
// smaller by the change of the tangent over the stiffness of the whole circuit, some percent at
// most where iron does not saturate
inline constexpr double kCorrected = 3e-5;

/// Whether the change of the fluxes is less than `share` of them.
template <class V>
[[gnu::always_inline]] inline bool IsSmall(const V& change, const V& fluxes, double share) {
  return Sum(change * change - fluxes * fluxes * (share * share)) <= 1e-36;
}

/// g m less what the rotor's potential takes, so that the fluxes of a radial bearing add
/// up to nothing.
template <Coupling kCoupling, class V>
[[gnu::always_inline]] inline V FluxOf(const V& g, const V& m, double inverse_sum) {
  const V gm = g * m;
  if constexpr (kCoupling == Coupling::kFloatingRotor)
    return gm - g * (CommonSum(gm) * inverse_sum);
  return gm;
}

/// The terms of a law near some flux: drop = base + slope phi.
template <class V>
struct LawTangent {
  V base, slope;
};
template <class V, class Kernel>
[[gnu::always_inline]] inline LawTangent<V> TangentAt(const Kernel& law, const V& phi) {
  V drop, slope;
  law.Terms(phi, &drop, &slope);
  return {drop - slope * phi, slope};
}

/// The fluxes at the end of a step. `tangent`: near the flux at its start; on return near that
/// at its end.
template <Coupling kCoupling, class V, class Kernel>
[[gnu::always_inline]] inline V SolveUnderLaw(const Kernel& law, const V& stiffness, const V& mmf,
                                              LawTangent<V>* tangent) {
  const auto inverse_sum = [](const V& g) {
    return kCoupling == Coupling::kFloatingRotor ? 1 / Sum(g) : 0.0;
  };
  if constexpr (Kernel::kLinear) {
    const V g = 1.0 / (stiffness + V(law.Slope()));
    return FluxOf<kCoupling>(g, mmf - law.Base(), inverse_sum(g));
  } else {
    const V g = 1.0 / (stiffness + tangent->slope);
    const double per_sum = inverse_sum(g);
    const V first = FluxOf<kCoupling>(g, mmf - tangent->base, per_sum);
    V drop, slope;
    law.Terms(first, &drop, &slope);
    // What the tangent did not tell; its conductances serve once more.
    const V untold = drop - (tangent->base + tangent->slope * first),
            correction = FluxOf<kCoupling>(g, untold, per_sum);
    *tangent = {drop - slope * first, slope};
    V next = first - correction;
    if (IsSmall(correction, next, kCorrected)) [[likely]]
      return next;
    for (int round = 0; round < kMostRounds; ++round) {
      *tangent = TangentAt(law, next);
      const V old = next, now = 1.0 / (stiffness + tangent->slope);
      next = FluxOf<kCoupling>(now, mmf - tangent->base, inverse_sum(now));
      if (IsSmall(V(next - old), next, kConverged)) break;
    }
    return next;
  }
}

template <Coupling kCoupling, class V, class Kernel, class State>
[[gnu::always_inline]] inline int RunLaw(State& state, const LawLoop& in, int k, int count) {
  const StatorLoop& s = in.circuit;
  Kernel law(state);
  const V n = LoadAs<V>(s.n), c = LoadAs<V>(s.c), inverse_l = LoadAs<V>(s.inverse_l),
          half_rh = LoadAs<V>(s.half_rh), leakage = LoadAs<V>(s.leakage), rel0 = LoadAs<V>(in.rel0),
          grows = LoadAs<V>(in.rel1) - rel0;
  const auto of_core = [](const V& x) {
    return kCoupling == Coupling::kSides ? V(x + Partner(x)) : x;
  };
  const V stiffness0 = rel0 + of_core(n * c);
  VoltSeconds<V> volt_seconds(s, k, in.h, V(1.0));
  V lambda = LoadAs<V>(s.lambda), i = LoadAs<V>(s.i), phi = LoadAs<V>(s.phi),
    sum = LoadAs<V>(s.sum);
  const double per = 1.0 / count;
  LawTangent<V> tangent = TangentAt(law, phi);
  for (; k < count; ++k) {
    Store(s.samples[k].v, i);
    const V target = lambda + volt_seconds.Next() - half_rh * i;
    const V next = SolveUnderLaw<kCoupling, V>(law, V(stiffness0 + grows * ((k + 1) * per)),
                                               of_core(c * target), &tangent);
    const V current = inverse_l * (target - n * next);
    if (-Largest(-current) < s.floor) break;
    i = current;
    phi = next;
    lambda = n * phi + leakage * i;
    sum += phi * phi;
    law.Commit(phi);
  }
  Store(s.lambda, lambda);
  Store(s.i, i);
  Store(s.phi, phi);
  Store(s.sum, sum);
  law.Keep(&state);
  return k;
}

template <class V, class Kernel, class State>
[[gnu::always_inline]] inline int RunLawLoop(State& state, const LawLoop& in, int k, int count) {
  switch (in.circuit.coupling) {
    case Coupling::kFloatingRotor:
      return RunLaw<Coupling::kFloatingRotor, V, Kernel>(state, in, k, count);
    case Coupling::kSides:
      return RunLaw<Coupling::kSides, V, Kernel>(state, in, k, count);
    case Coupling::kNone:
      return RunLaw<Coupling::kNone, V, Kernel>(state, in, k, count);
    case Coupling::kNetwork:
      break;
  }
  return k;
}

#define AMBRIG_LAW_LANES(Name)                                                                \
  AMBRIG_WIDE void Name##Drop(const Name##State& state, const Lane& phi, Lane* drop,          \
                              Lane* slope) {                                                  \
    LaneVector d, t;                                                                          \
    Name##Kernel<LaneVector>(state).Terms(Load(phi.v), &d, &t);                               \
    Store(drop->v, Load(drop->v) + d);                                                        \
    Store(slope->v, Load(slope->v) + t);                                                      \
  }                                                                                           \
  AMBRIG_WHOLE int Name##LoopWhole(Name##State& state, const LawLoop& in, int k, int count) { \
    return RunLawLoop<WholeLaneVector, Name##Kernel<WholeLaneVector>>(state, in, k, count);   \
  }                                                                                           \
  AMBRIG_WIDE int Name##LoopHalves(Name##State& state, const LawLoop& in, int k, int count) { \
    return RunLawLoop<LaneVector, Name##Kernel<LaneVector>>(state, in, k, count);             \
  }                                                                                           \
  int Name##Loop(Name##State& state, const LawLoop& in, int k, int count) {                   \
    return (whole_lanes ? Name##LoopWhole : Name##LoopHalves)(state, in, k, count);           \
  }

/// NameCommit, of laws that remember.
#define AMBRIG_LAW_COMMIT(Name)                                        \
  AMBRIG_WIDE void Name##Commit(Name##State& state, const Lane& phi) { \
    Name##Kernel<LaneVector> law(state);                               \
    law.Commit(Load(phi.v));                                           \
    law.Keep(&state);                                                  \
  }

}  // namespace ambrig
