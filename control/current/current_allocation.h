#pragma once
/// What may stand in for a matrix W on the way from wanted forces to set-points: an inverse with a
/// memory of its last currents, told where the rotor is. One call per controller period.
#include <Eigen/Dense>

namespace ambrig {

using SetPointVector = Eigen::Matrix<double, 8, 1>;  // [A]

class CurrentAllocation {
 public:
  virtual ~CurrentAllocation() = default;
  /// Forces [N] and the rotor's position [m], as measured, to set-points.
  virtual SetPointVector Step(double fx, double fy, double x, double y) = 0;
  /// The forces of the last call [N].
  virtual Eigen::Vector2d LastForce() const = 0;
};

}  // namespace ambrig
