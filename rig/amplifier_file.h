#pragma once
/// The [amplifier] of a rig file.
#include "core/base/toml.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Allowed words of `modulation`; two-level and three-level are other names of the first two.
inline constexpr char kModulations[] =
    "bi-state, tri-state, chopper, ideal, two-level, three-level, interleaved, linear";

/// Fills rig.amplifier. @throws InputError
void ReadAmplifier(const TomlTable& t, RigParameters& rig);

/// Once the bearings are read: of an amplifier with a bandwidth kp and ki that give it to the coil
/// with the largest inductance, pole and zero cancelled. @throws InputError
void TuneAmplifier(const TomlTable& t, RigParameters& rig);

}  // namespace ambrig
