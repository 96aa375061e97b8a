#pragma once
/// How set-points get from an old distribution of currents to a new one: one step per controller
/// period, between the map and the current loops, until the set-points are those of the new map.
/// Policies: faulttolerance/supervision/current_transition_policy.h.
#include <memory>

#include "control/current/current_allocation.h"

namespace ambrig {

class CurrentTransition {
 public:
  virtual ~CurrentTransition() = default;
  /// `wanted`: set-points of the new map for `force` [N]. Returns what is commanded now.
  virtual CoilVector Step(const CoilVector& wanted, const Eigen::Vector2d& force) = 0;
  /// The new map's set-points have been reached; Step hands them through.
  virtual bool done() const = 0;
  virtual std::unique_ptr<CurrentTransition> Clone() const = 0;
};

}  // namespace ambrig
