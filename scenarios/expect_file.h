#pragma once
/// The [expect] table of a scenario, and which runs can meet what it asks of fault detection.
#include <string>

#include "core/base/toml.h"
#include "scenarios/scenario.h"

namespace ambrig {

/// Why fault detection cannot watch this run, as a clause: "the rotor is clamped". Empty: it can,
/// at a fidelity that has it.
std::string WhyUnwatched(const RigParameters& rig, const Scenario& s);

/// Reads `s.expect`; everything else of `s` is known. @throws InputError with file:line, also for a
/// key that this run cannot meet; one that wants no fault tolerance (fault_tolerance = false, to
/// see the difference) is left to fail.
void ReadExpect(const TomlTable& root, const RigParameters& rig, Scenario& s);

}  // namespace ambrig
