#pragma once
/// The magnetic circuit of any stator (pole_network.h) at one place of the shaft, in lanes: one per
/// coil, poles in groups of as many.
///
///   φ = P m + φ_m      mean flux through a turn of every coil, m: its ampere-turns    [Wb], [A]
///   Φ = F m + Φ_m      fluxes of the poles; φ_m, Φ_m: of the magnets                  [Wb]
///   f = Σ w Φ²         force on the rotor, w = d/(2 mu0 A)                            [N]
///
/// P_jc = (Nᵀ phi)_jc/(T_j T_c), T: turns of a coil over all of its poles. Coils that are driven
/// are Norton sources (stator_lanes.h), m = M - K φ. Then
///
///   (1 + P K) φ = P M + φ_m
///
/// which scaled by √K is symmetric with no eigenvalue below 1: elimination needs no pivots, and a
/// coil that carries nothing (K = M = 0) follows the others. Source: docs/theory/stators.md.
#include <Eigen/Dense>

#include "actuators/magnetics/lane.h"
#include "actuators/magnetics/pole_network.h"

namespace ambrig {

inline constexpr int kPoleGroups = kMostPoles / kLanes;

/// Fluxes per ampere-turn of one coil [Wb/A], or of the magnets [Wb].
struct NetworkColumn {
  Lane turn;               // through a turn of every coil
  Lane pole[kPoleGroups];  // of the poles
};

struct NetworkPlace {
  const PoleNetwork* network = nullptr;  // whose, at (x, y) [m]
  double x = 0, y = 0;
  int coils = 0, groups = 0;                      // in use; the others are zero
  NetworkColumn column[kLanes], magnets;          // of P and F; φ_m and Φ_m
  Lane pull_x[kPoleGroups], pull_y[kPoleGroups];  // w [N/Wb²]
};

NetworkPlace PlaceOf(const PoleNetwork& network, double x, double y);
/// `out`, a copy of `a` or of another place on the way: P, F and the magnets' fluxes at this
/// fraction from `a` to `b`.
void PlaceBetween(const NetworkPlace& a, const NetworkPlace& b, double fraction, NetworkPlace* out);

/// φ under these ampere-turns.
Lane FluxUnder(const NetworkPlace& place, const Lane& ampere_turns);
/// φ of Norton sources M with K [A], [A/Wb].
Lane FluxOfSources(const NetworkPlace& place, const Lane& source, const Lane& own);
/// f under these ampere-turns, x and y.
Eigen::Vector2d PullUnder(const NetworkPlace& place, const Lane& ampere_turns);

}  // namespace ambrig
