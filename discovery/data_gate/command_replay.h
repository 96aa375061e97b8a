#pragma once
/// The controller's program replayed with the commands of a scenario and without them: what a
/// record's set-points show of its commands follows from the two.
#include <Eigen/Core>
#include <vector>

#include "discovery/model/controller_block.h"

namespace ambrig {

/// Axes in the same order, rows as in ControllerAxis.
struct CommandReplay {
  std::vector<ControllerAxis> silent, now;  // without commands, with them
};

/// `now`: of this record with its scenario.
CommandReplay ReplayCommands(const RigParameters& rig, const Scenario& scenario,
                             const BridgedRecord& data, std::vector<ControllerAxis> now);

/// The errors of all axes, rows that count only [A].
Eigen::VectorXd CountedErrors(const std::vector<ControllerAxis>& axes);

}  // namespace ambrig
