#pragma once
/// Generalised bias-current linearisation after coil failures (base_model.md section 5): finds W
/// with i = W [c0, vx, vy]' such that F = k c0 v at the centre, failed rows zero, currents within
/// [0, i_max] (two quadrants) on the disc |v| <= rho c0. Many deterministic starts on the
/// equations, then a search by NLopt from each (force_forms.h, program_search.h).
///
/// Three classes, algebraic, signs of the currents left aside: exact (all 12 equations), linearised
/// (no bias force and full gain at v = 0; what is left grows with |v|^2), none.
/// "exact" accepts only solutions with entries up to 50 (healthy: 1): other sets of four approach
/// the equations only as the currents go to infinity, which is no solution.
#include <cstdint>

#include "faulttolerance/redistribution/force_forms.h"

namespace ambrig {

enum class SolvabilityClass { kExact, kLinearised, kNone };
const char* ToText(SolvabilityClass c);  // "exact", "linearised", "none"

/// What the freedom left by the equations is spent on.
enum class DistributionPolicy {
  kControl,  // smallest negative stiffness at a share of the best capacity (the simulator's choice)
  kCapacity,  // largest load capacity first, then negative stiffness, then copper loss
};

struct DistributionOptions {
  DistributionPolicy policy = DistributionPolicy::kControl;
  double capacity_share = 0.6;   // kControl: of the best rho, kept as working disc
  double rho_floor = 0.5;        // kControl: at least this disc if 0.9 of the best rho allows it
  double rho_needed = 0.35;      // kControl: an exact W with less gives way to a linearised one
  double rho_same_flux = 0.8;    // kControl, partial shorts: keep the healthy fluxes down to this
  double bias_weight = 0.05;     // of |b|^2/8 against largest stiffness, healthy 1: copper loss
  double control_weight = 0.05;  // of (|wx|^2 + |wy|^2)/8, healthy 1: voltage for a force's slew
  int starts = 64;               // of a search, and as many from its disturbed best
  std::uint64_t seed = 1;
};

struct Distribution {
  SolvabilityClass cls = SolvabilityClass::kNone;
  DistributionMatrix W = DistributionMatrix::Zero();
  double residual = 0;    // largest of the 12 equations' errors over k/2
  double rho = 0;         // currents within range on |v| <= rho c0 (i_max alone when not unipolar)
  bool unipolar = false;  // no current negative there, and rho > 0
  double capacity_flux = 0;     // of this W over the healthy bearing, flux limit per pole
  double capacity_current = 0;  // of this W over the healthy bearing, i_max (and sign)
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();  // dF/dx at v = 0 [N/m], never negative
  double copper_loss = 0;  // of the bias: sum b_j^2 tau_j / 8, healthy 1
};

/// Class of the set of live coils alone; turns left and winding do not change it.
SolvabilityClass Classify(const RedistributionProblem& problem);

/// The healthy bearing has its conventional W. A set that is not exactly solvable gets the best
/// linearised W, and one that is not even that, the W of least error: `cls` and `residual` tell.
/// Two quadrants, where currents of one sign cannot do what the class allows: kCapacity gives a W
/// with negative currents (unipolar = false), kControl the W of least error within the bounds; and
/// kControl gives up exactness when only a linearised W reaches rho_needed.
Distribution SolveDistribution(const RedistributionProblem& problem,
                               const DistributionOptions& options = {});

/// All figures of a given W.
Distribution Describe(const RedistributionProblem& problem, SolvabilityClass cls,
                      const DistributionMatrix& W);

/// Largest flux-limited capacity of any exact W found; 0 when there is none.
double BestFluxCapacity(const RedistributionProblem& problem, const DistributionOptions& options);

}  // namespace ambrig
