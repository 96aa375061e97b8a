#pragma once
/// Bearings, seals and point masses of ROSS's rotor file as supports and housings.
#include "rotor/shaft/beam.h"
#include "rotor/shaft/ross_elements.h"

namespace ambrig {

/// A magnetic bearing, whatever class it was saved as: version 2.3 saves one as a BearingElement with the
/// coefficients of its controller at some speeds.
bool IsRossMagneticBearing(const RossElement& element);

/// Adds supports, point masses on the shaft, and housings at the nodes that are off the shaft; `z` are the
/// planes of the shaft's nodes. What has no counterpart goes to `lost`.
void AddRossSupports(const std::vector<RossElement>& elements, const std::vector<double>& z,
                     BeamDefinition& definition, std::vector<std::string>& lost);

}  // namespace ambrig
