#pragma once
/// What a validation file (validation.h) asks of a rig: quantities of one bearing axis.
#include <string>
#include <vector>

#include "core/base/toml.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// The figures of `quantity` for the axis that `check` names.
/// @throws InputError for an axis or a quantity that the rig does not have.
std::vector<double> FiguresOfRig(const RigParameters& rig, const TomlTable& check,
                                 const std::string& quantity);

}  // namespace ambrig
