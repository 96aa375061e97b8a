#pragma once
/// The [rotor] of a rig file: rigid, a point on one axis, or a beam
/// (rotor/shaft/beam_file.h), which is reduced here to its rigid body and the first
/// `modes` bending modes.
#include "core/base/toml.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Fills rotor_kind, rotor, modes, beam, z_origin. @throws InputError.
void ReadRotor(const TomlTable& rotor, RigParameters& rig);

/// Planes of the magnets on the file's axis [m] whose residual modes follow the bending modes of
/// the beam; none without `static_correction`.
std::vector<double> ResidualPlanes(const RigParameters& rig);

/// Another value of rig.beam->parameters[parameter]: mass, inertias and modes follow, and every z,
/// for the centre of mass moves.
void SetShaft(RigParameters& rig, std::size_t parameter, double value);

/// Once amplifier and bearings are read: every z from the file's axis to the centre of mass,
/// checked to lie on the shaft; modes that the switching period cannot carry are refused. Rigid:
/// nothing.
void PlaceOnShaft(const TomlTable& root, RigParameters& rig);

}  // namespace ambrig
