#pragma once
/// Seam for iron that is not ideal: the extra MMF that a pole's iron needs besides its gap,
/// all lanes of a bearing in one call. A lane is a coil: its pole, or of a network of
/// poles all those that the coil links, as one with their mean flux. The base rig has none
/// (ideal iron, fast path); effects implement it (eddy currents, saturation, hysteresis).
///
/// Within one step of h seconds the flux of a lane runs linearly from its committed value to φ.
/// The two windings of a thrust side share one core: they see the same flux, so the law holds the
/// same state twice and the core's MMF is counted once.
#include <optional>
#include <vector>

#include "actuators/magnetics/lane.h"
#include "actuators/magnetics/stator_loop.h"

namespace ambrig {

/// A bearing's samples as RunSamples of stator_loop.h sees them, and what a law needs beside:
/// reluctances at both ends of the period [1/H], length of a sample [s].
struct LawLoop {
  StatorLoop circuit;
  const double *rel0, *rel1;
  double h;
};

/// A law for small changes of a flux that has stood:
///
///   δM = slope δφ - Σ w_k δz_k + damping δφ',   z_k' = p_k (δφ - δz_k)
struct LinearDrop {
  struct Relaxation {
    double rate, weight;  // p_k [rad/s], w_k [A/Wb]
  };
  Lane slope;                           // of a flux that changes at once [A/Wb]
  std::vector<Relaxation> relaxations;  // alike in all lanes
  double damping = 0;                   // [A s/Wb]
};

class FluxLaw {
 public:
  virtual ~FluxLaw() = default;
  /// The law near a flux that has stood; nothing where small changes have no linear law
  /// (hysteresis).
  virtual std::optional<LinearDrop> LinearAt(const Lane& /*phi*/) const { return std::nullopt; }
  /// Whether Drop is linear in the flux, so that one round of Newton is exact.
  virtual bool linear() const { return false; }
  /// Length of the steps to come [s].
  virtual void SetStep(double /*h*/) {}
  /// Adds the MMF drops [A] and their slopes [A/Wb] if the fluxes are `phi` at the end of the step.
  virtual void Drop(const Lane& phi, Lane* drop, Lane* slope) const = 0;
  /// The same for a flux that was raised from nothing and has stood for ever (start of a run).
  virtual void Steady(const Lane& phi, Lane* drop, Lane* slope) const = 0;
  /// The step is taken: remember it (turning points, diffused flux).
  virtual void Commit(const Lane& phi) = 0;
  /// Samples k .. count - 1 in one loop, where this is the bearing's only law (law_loop.h); returns
  /// the sample in whose solution a current falls below the floor, in the state of its start, or
  /// `count`. k: the law has no such loop.
  virtual int RunSamples(const LawLoop& /*loop*/, int k, int /*count*/) { return k; }
  /// Settle at a steady flux.
  virtual void Settle(const Lane& phi) = 0;
};

}  // namespace ambrig
