#pragma once
/// The door to SLICOT, the subroutine library of systems and control theory (Debian libslicot-dev).
/// Nobody else calls it.
#include "control/linear/state_space.h"

namespace ambrig {

struct HInfinityOutcome {
  StateSpace controller;  // (measurements -> controls)
  bool usable = false;
  int info = 0;  // SLICOT's own: 6, 7: gamma too small; others: a rank or Riccati failure
};

/// Discrete H-infinity (sub)optimal controller u = K y with ||T_zw|| < gamma for the plant with
/// inputs (w, u), outputs (z, y), `controls` last columns, `measurements` last rows. SB10DD: Green
/// and Limebeer's formulas.
HInfinityOutcome DiscreteHInfinity(const StateSpace& plant, int controls, int measurements,
                                   double gamma);

}  // namespace ambrig
