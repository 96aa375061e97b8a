#pragma once
/// Currents from forces by bias-current linearisation: i_set = W [c0, vx, vy]', v = f/(k c0),
/// set-points clamped to [0, i_max] (two-quadrant bridges) or ±i_max.
/// Healthy: row j of W = [1, cos γ_j, sin γ_j]. Source: docs/theory/base_model.md sections 4, 5.
///
/// After a failure W may have another negative stiffness than the controller was made for, in other
/// directions: `stiffness_change` = K_healthy - K_now [N/m] makes it up from the measured position,
/// f + stiffness_change (x, y)'. An `allocation` takes the place of W.
#include <memory>

#include "control/current/current_allocation.h"

namespace ambrig {

struct CurrentMap {
  Eigen::Matrix<double, 8, 3> W = Eigen::Matrix<double, 8, 3>::Zero();
  double k = 0;      // [N/A²]
  double c0 = 0;     // [A]
  double i_max = 0;  // [A]
  bool unipolar = true;
  Eigen::Matrix2d stiffness_change = Eigen::Matrix2d::Zero();
  std::shared_ptr<CurrentAllocation> allocation;

  /// Forces [N], position [m] -> set-points [A].
  CoilVector SetPoints(double fx, double fy, double x = 0, double y = 0) const {
    const Eigen::Vector2d f = Eigen::Vector2d(fx, fy) + stiffness_change * Eigen::Vector2d(x, y);
    const CoilVector set =
        allocation ? allocation->Step(f.x(), f.y(), x, y)
                   : CoilVector(W * Eigen::Vector3d(c0, f.x() / (k * c0), f.y() / (k * c0)));
    return set.cwiseMax(unipolar ? 0.0 : -i_max).cwiseMin(i_max);
  }
};

}  // namespace ambrig
