#pragma once
/// How far the rotor can move at a bearing.
#include "rig/rig_parameters.h"

namespace ambrig {

/// To the poles, rotor centred [m].
double GapOf(const BearingParameters& b);
/// Before something touches: the auxiliary bearing's clearance, else half of the gap [m].
double ClearanceOf(const BearingParameters& b);

}  // namespace ambrig
