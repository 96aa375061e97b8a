#pragma once
/// The levitated equilibrium of a rig by KINSOL: forces of the axes and coordinates at which every
/// sensor reads zero and nothing accelerates, with the healthy current map between forces and
/// coils.
///
///   unknowns   f (one per controlled axis) [N], q (all coordinates) [m]
///   equations  reading_axis(q) = 0;  a_d(q, f) = 0 for every coordinate that a force can move
///
/// At standstill: what turns with the shaft (unbalance) has no equilibrium. Where the axes do not
/// hold every coordinate (one magnet on a bench) there is no unique one and `converged` is false.
/// Source: docs/theory/base_model.md sections 1, 2, 4.
#include <string>
#include <vector>

#include "actuators/magnetics/lane.h"
#include "rotor/motion/force_term.h"
#include "scenarios/scenario.h"

namespace ambrig {

class SampledDataLoop;

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

Equilibrium LevitatedEquilibrium(const SampledDataLoop& rig);
/// The same for an engine without a sampled rig of its own.
Equilibrium LevitatedEquilibrium(const RigParameters& rig, const Scenario& scenario);

}  // namespace ambrig
