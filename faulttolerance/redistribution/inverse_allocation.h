#pragma once
/// The force-by-force inverse in the place of W (control/current/current_allocation.h).
#include "control/current/current_allocation.h"
#include "faulttolerance/redistribution/force_inverse.h"

namespace ambrig {

/// The inverse knows the rotor's position, so its forces carry no negative stiffness of their own;
/// the controller was made for a bearing with one, so the stiffness of the healthy W is added back
/// (`stiffness` [N/m]). Where its branch ends (the force is missed for some periods) it searches
/// again.
class InverseAllocation : public CurrentAllocation {
 public:
  InverseAllocation(const ForceInverse& started, const Eigen::Matrix2d& stiffness)
      : inverse_(started), stiffness_(stiffness) {}
  CoilVector Step(double fx, double fy, double x, double y) override;
  Eigen::Vector2d LastForce() const override { return force_; }
  int searches() const { return searches_; }

 private:
  ForceInverse inverse_;
  Eigen::Matrix2d stiffness_;
  Eigen::Vector2d force_ = Eigen::Vector2d::Zero();
  int missed_ = 0, wait_ = 0, searches_ = 0;  // [periods]
};

}  // namespace ambrig
