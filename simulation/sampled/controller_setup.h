#pragma once
/// From the controllers that a rig file names to controllers that run.
#include "control/position/controller_switch.h"
#include "rig/nominal_rig.h"

namespace ambrig {

/// One controller of the rig for all its axes; bearings with their own have their PID. `maps`: from
/// forces to currents, one per bearing, that a synthesis designs for; empty: those
/// of healthy bearings.
/// @throws InputError when a synthesis fails.
std::unique_ptr<PositionController> MakeController(const NominalRig& rig,
                                                   const ControllerParameters& c,
                                                   const std::vector<CurrentMap>& maps = {});

/// The controller of the bearings that have none of their own, and the names of its axes.
/// @throws InputError when a synthesis fails.
std::unique_ptr<PositionController> MakeCentralController(const NominalRig& rig,
                                                          const ControllerParameters& c,
                                                          std::vector<std::string>* axes = nullptr,
                                                          const std::vector<CurrentMap>& maps = {});

/// All of the rig, [controller] in charge: 0, then those of [controllers.NAME] in their order.
std::unique_ptr<ControllerSwitch> MakeControllerSwitch(const NominalRig& rig);

/// Largest force per axis [N].
std::vector<double> ForceLimits(const NominalRig& rig, const ControllerParameters& c);

}  // namespace ambrig
