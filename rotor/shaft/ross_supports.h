#pragma once
/// Bearings, seals and point masses of ROSS's rotor file as supports and housings.
#include "rotor/shaft/beam.h"
#include "rotor/shaft/ross_nodes.h"

namespace ambrig {

/// Adds supports, point masses on the shaft, and housings at the nodes that are off the
/// shaft. What has no counterpart goes to `lost`.
void AddRossSupports(const std::vector<RossElement>& elements, const RossNodes& nodes,
                     BeamDefinition& definition, std::vector<std::string>& lost);

}  // namespace ambrig
