#pragma once
/// What a check of a validation file may ask of a rotor: nodes that exist, springs that hold it.
#include "core/base/toml.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {

/// The node of the mesh at z [m], the value of `key`. @throws InputError that lists the nodes.
int NodeOf(const BeamRotor& beam, const TomlTable& t, const char* key, double z);

/// Undamped critical speeds want a rotor that is held by symmetric springs. @throws InputError
void CheckSprings(const TomlTable& check, const LinearRotor& rotor);

}  // namespace ambrig
