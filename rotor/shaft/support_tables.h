#pragma once
/// The tables of what holds a shaft and of what hangs on it (rotor/shaft/beam_file.h shows them).
#include <vector>

#include "core/base/toml_checked.h"
#include "rotor/shaft/beam.h"

namespace ambrig {

SpringSupport ReadSupport(const TomlTable& row, std::vector<Tolerance>* tolerances);
Housing ReadHousing(const TomlTable& row);
PointMass ReadPointMass(const TomlTable& row);

/// Every housing that a support names exists, no two have one name. @throws InputError
void CheckHousings(const TomlTable& rotor, const BeamDefinition& definition);

}  // namespace ambrig
