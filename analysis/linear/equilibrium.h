#pragma once
/// The levitated equilibrium of a rig by KINSOL: forces of the axes and coordinates at which every
/// sensor reads zero and nothing accelerates, with the healthy current map between forces and
/// coils.
///
///   unknowns   f (one per controlled axis) [N], q (all coordinates) [m]
///   equations  reading_axis(q) = 0;  a_d(q, f) = 0 for every coordinate that a force can move
///
/// At standstill: what turns with the shaft (unbalance, run-out) has no equilibrium. Where the axes
/// do not hold every coordinate (one magnet on a bench) there is no unique one and `converged` is
/// false.
#include <string>
#include <vector>

#include "control/current/bearing_control.h"
#include "effects/plant.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

struct Equilibrium {
  std::vector<double> force;  // per axis [N]
  DofVector q{};              // coordinates, as MotionState
  std::vector<Lane> current;  // set-points per bearing [A]
  double residual = 0;        // largest equation error over its scale (g, 1 um)
  int iterations = 0;
  bool converged = false;
  std::string message;
  bool usable() const { return converged; }
};

/// Controlled axes of a bearing: 2 of a radial one, else 1.
std::size_t AxesOf(const BearingPlant& bearing);

/// What of sensors and iron an equilibrium knows.
enum class EquilibriumOf {
  kIdealParts,  // readings are positions, coils carry their set-points, iron has no reluctance
  kTrueParts    // maps of the position sensors, errors of the current sensors, laws of the iron
};

/// The current [A] that a coil carries under `set_point` [A]: under a current loop that at which
/// its sensor reads it.
double CarriedCurrent(const AmplifierParameters& amplifier, const BearingPlant& bearing, int coil,
                      double set_point);

/// `rig`: true values, for the first guess; `control`: the maps between forces and set-points.
/// kTrueParts: the laws of the plant's iron are left as they settled last.
Equilibrium LevitatedEquilibrium(const RigParameters& rig, const Plant& plant,
                                 const std::vector<BearingControl>& control,
                                 EquilibriumOf parts = EquilibriumOf::kIdealParts);

}  // namespace ambrig
