#pragma once
/// What may stand in for a matrix W on the way from wanted forces to set-points: an inverse with a
/// memory of its last currents, told where the rotor is. One call per controller period.
#include <Eigen/Dense>

#include "actuators/magnetics/radial_stator.h"

namespace ambrig {

class CurrentAllocation {
 public:
  virtual ~CurrentAllocation() = default;
  /// Forces [N] and the rotor's position [m], as measured, to set-points [A].
  virtual CoilVector Step(double fx, double fy, double x, double y) = 0;
  /// The forces of the last call [N].
  virtual Eigen::Vector2d LastForce() const = 0;
};

}  // namespace ambrig
