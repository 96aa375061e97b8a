#pragma once
/// What of a beam is modelled, as [rotor] says it: mass, shear, rotary_inertia, gyroscopic, layers,
/// shear_coefficient, element (rotor/shaft/beam_file.h).
#include "core/base/toml.h"
#include "rotor/shaft/shaft_element.h"

namespace ambrig {

/// What the table does not say stays as it was. @throws InputError for another word, or what does
/// not go together.
BeamTheory ReadTheory(const TomlTable& rotor, BeamTheory theory);

}  // namespace ambrig
