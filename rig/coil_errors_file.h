#pragma once
/// The `coil_errors` of a bearing in a rig file: { current_gain = [...], edge = [...] }, one
/// number per coil.
#include "core/base/toml.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Fills `b.coil_errors`; its kind and coils are known. @throws InputError
void ReadCoilErrors(const TomlTable& bearing, BearingParameters& b);

}  // namespace ambrig
