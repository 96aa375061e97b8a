#pragma once
/// Planes of a shaft as a person names them.
#include "analysis/shaft/shaft_analysis.h"

namespace ambrig {

/// A disk, station, support or housing by its name, or a place on the shaft in m; `option` names
/// what asked for it.
/// @throws InputError naming the planes that exist.
ShaftProbe FindPlane(const BeamFile& file, const PlaneChoice& choice, const char* option);

/// The planes of supports, disks and stations that have a name, and the housings; without any, both
/// ends.
std::vector<ShaftProbe> NamedPlanes(const BeamFile& file, const BeamRotor& beam);

}  // namespace ambrig
