#pragma once
/// How far the rotor can move at a bearing.
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// To the poles, rotor centred [m].
double GapOf(const BearingParameters& b);
/// The gap of the bearing that has this axis ("A.x"), which no reading of it can exceed by much
/// [m]; infinity where no bearing has it.
double GapOfAxis(const RigParameters& rig, const std::string& axis);
/// Before something touches: the auxiliary bearing's clearance, else half of the gap [m].
double ClearanceOf(const BearingParameters& b);

/// Whether a shaft at (x, y) [m] would stand in a pole; y is 0 of a bearing with one axis.
bool InPole(const BearingParameters& b, double x, double y);
/// The same with its poles at `gap` [m] from a centred rotor.
bool InPole(const BearingParameters& b, double gap, double x, double y);

}  // namespace ambrig
