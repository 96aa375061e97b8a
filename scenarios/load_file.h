#pragma once
/// The [[load]] tables of a scenario.
#include "core/base/toml.h"
#include "scenarios/scenario.h"

namespace ambrig {

/// Reads the loads of `s`, whose duration is known. @throws InputError with file:line.
void ReadLoads(const TomlTable& root, const RigParameters& rig, Scenario& s);

}  // namespace ambrig
