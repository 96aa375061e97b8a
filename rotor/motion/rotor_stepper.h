#pragma once
/// Seam: who moves the rotor over one switching period. The engine's own is RotorModel::Step
/// (compliant contact, Runge-Kutta); rotor/crosscheck/ode_rotor.h is the independent model.
#include "rotor/linear/force_term.h"

namespace ambrig {

class RotorStepper {
 public:
  virtual ~RotorStepper() = default;
  /// Advances `s` by dt [s] under constant magnetic forces `Q`; `stator_x`, `stator_y` [N] are what
  /// the stator pushes on the rotor (its reaction moves a base).
  virtual void Step(MotionState& s, const DofVector& Q, double stator_x, double stator_y,
                    double dt) = 0;
};

}  // namespace ambrig
