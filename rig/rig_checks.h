#pragma once
/// Contradictions between the parts of a rig, each of which alone is in its range.
#include <utility>

#include "core/base/toml.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Where the shaft is [m], in the rig's coordinates: a beam's ends; of a rigid rotor, whose length
/// is not given, the outermost planes and one bearing span beyond them.
std::pair<double, double> ShaftExtent(const RigParameters& rig);

/// Bias currents that the amplifier cannot drive, windings without a return of the flux, sensors
/// beside the shaft, fitted values that contradict each other, an effect named twice. @throws
/// InputError with file:line.
void CheckRig(const TomlTable& root, const RigParameters& rig);

}  // namespace ambrig
