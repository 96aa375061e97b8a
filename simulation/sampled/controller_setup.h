#pragma once
/// From the controllers that a rig file names to controllers that run.
#include "control/position/controller_switch.h"
#include "rig/rig_parameters.h"

namespace ambrig {

/// One controller of the rig for all its axes; bearings with their own have their PID. `rig`:
/// nominal values, what the controller is designed with.
/// @throws InputError when a synthesis fails.
std::unique_ptr<PositionController> MakeController(const RigParameters& rig,
                                                   const ControllerParameters& c);

/// All of the rig, [controller] in charge: 0, then those of [controllers.NAME] in their order.
std::unique_ptr<ControllerSwitch> MakeControllerSwitch(const RigParameters& rig);

/// Largest force per axis [N].
std::vector<double> ForceLimits(const RigParameters& rig, const ControllerParameters& c);

}  // namespace ambrig
