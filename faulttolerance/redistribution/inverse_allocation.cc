#include "faulttolerance/redistribution/inverse_allocation.h"

#include <algorithm>

namespace ambrig {

namespace {
constexpr double kMissedBeforeSearch = 0.1, kMissedForceBeforeSearch = 2;  // of the force, [N]
constexpr int kPatience = 8, kRest = 200;  // periods of missing, periods between searches
}  // namespace

CoilVector InverseAllocation::Step(double fx, double fy, double x, double y) {
  force_ = {fx, fy};
  const Eigen::Vector2d wanted = force_ + stiffness_ * Eigen::Vector2d(x, y);
  inverse_.Step(wanted, x, y);
  const bool missed = (inverse_.force() - wanted).norm() >
                      kMissedForceBeforeSearch + kMissedBeforeSearch * wanted.norm();
  missed_ = missed ? missed_ + 1 : 0;
  wait_ = std::max(wait_ - 1, 0);
  if (missed_ >= kPatience && wait_ == 0) {
    wait_ = kRest;
    ForceInverse other = inverse_;
    if (other.Start(wanted, x, y)) {
      inverse_ = other;
      missed_ = 0;
      ++searches_;
    }
  }
  return inverse_.current();
}

}  // namespace ambrig
