#pragma once
/// Numbers of a [rotor] table with { value, sd }: what a calibration may move of a shaft.
///
///   rotor.materials.NAME.E | rho | nu          every section, sleeve and disk made of it
///   rotor.section[k].od | id | od_right | id_right | damping_mass | damping_stiffness
///                    | E | rho | nu
///   rotor.sleeve[k]. the same                  k from 1, as error messages count
///   rotor.disk[k].mass | inertia_diametral | inertia_polar | rho
///   rotor.support[k].k | c | kxx | cxx | ...   constant coefficients of a support
///   rotor.modal_damping                        one ratio for all modes
///
/// What a table leaves to another number follows it: od_right follows od, a section its material.
/// Lengths and planes are not among them: they would move the bearings along the shaft.
#include <string>
#include <vector>

#include "rotor/shaft/beam_file.h"

namespace ambrig {

/// A ShaftParameter for every tolerance of a beam's [rotor], in their order.
/// @throws InputError at `rotor` for a number that cannot be moved.
std::vector<ShaftParameter> FindShaftParameters(const TomlTable& rotor, const BeamFile& file,
                                                const std::vector<Tolerance>& tolerances);

/// Moves a number of the shaft and all that follows it. @throws std::logic_error for another index.
void SetShaftParameter(BeamFile& file, std::size_t index, double value);

}  // namespace ambrig
