#pragma once
/// What differs from coil to coil of one rig although its parts have the same name: the gains
/// of the current measurements and the instants at which the bridges switch (dead times that are
/// not known exactly).
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

struct Plant;

/// Whether the rig file says that the coils of a machine differ.
bool CoilsDiffer(const AmplifierParameters& amplifier);

/// Draws every coil's errors from current_gain_spread, edge_spread and `unit`: the same rig has the
/// same ones in every run. On top of those that effects have given it; a bearing whose coil errors
/// are known draws none of them. `plant` was built from `rig`.
void DrawCoilSpread(const RigParameters& rig, Plant* plant);

}  // namespace ambrig
