#pragma once
/// How a bearing meets the shaft: across it at a plane of its own, in x and y, or along it, in
/// z. Kinds of bearing name these functions in their rows (rig/parameters/bearing_kind.h).
#include <array>
#include <string>
#include <vector>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

class RotorModel;
struct PlaneMap;

/// "A.x", "A.y"
std::vector<std::string> AxesAcross(const BearingParameters& b);
/// The shaft's motion at z [m].
PlaneMap PlaneAcross(const BearingParameters& b, const RotorModel& rotor, double z);
/// At the bearing's own z unless the rig file gives another one.
void AddAuxiliaryAtPlane(const BearingParameters& b, RotorModel& rotor);

/// "z"
std::vector<std::string> AxisAlong(const BearingParameters& b);
std::array<double, 3> DirectionAlong(const BearingParameters& b);
/// The shaft's axial motion at z [m].
PlaneMap PlaneAlong(const BearingParameters& b, const RotorModel& rotor, double z);
void SetAxialStopOf(const BearingParameters& b, RotorModel& rotor);

}  // namespace ambrig
