#pragma once
/// [start] of a scenario: levitated, resting on the auxiliary bearings, or clamped at a position.
#include "core/base/toml.h"
#include "scenarios/scenario.h"

namespace ambrig {

/// @throws InputError with file:line; resting needs two radial auxiliary bearings and gravity
/// across the shaft, a clamped shaft stays inside the gaps.
void ReadStart(const TomlTable& root, const RigParameters& rig, Scenario& s);

}  // namespace ambrig
