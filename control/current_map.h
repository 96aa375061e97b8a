#pragma once
/// Currents from forces by bias-current linearisation: i_set = W [c0, vx, vy]', v = f/(k c0),
/// set-points clamped to [0, i_max] (two-quadrant bridges) or ±i_max.
/// Healthy: row j of W = [1, cos γ_j, sin γ_j]. Source: shared/design/physics.md sections 4, 5.
#include <Eigen/Dense>

namespace ambrig {

struct CurrentMap {
  Eigen::Matrix<double, 8, 3> W = Eigen::Matrix<double, 8, 3>::Zero();
  double k = 0;      // [N/A²]
  double c0 = 0;     // [A]
  double i_max = 0;  // [A]
  bool unipolar = true;

  /// Forces [N] -> set-points [A].
  Eigen::Matrix<double, 8, 1> SetPoints(double fx, double fy) const {
    const Eigen::Vector3d command(c0, fx / (k * c0), fy / (k * c0));
    return (W * command).cwiseMax(unipolar ? 0.0 : -i_max).cwiseMin(i_max);
  }
};

}  // namespace ambrig
