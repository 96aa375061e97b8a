#pragma once
/// The `[rotor]` table of a rig file with kind = "beam":
///
///     [rotor]
///     kind = "beam"
///     modes = 3                        # bending modes kept by the simulator
///     modal_damping = 0.002            # ratio of each, or one per mode: [0.002, 0.004]
///     elements_per_section = 4
///     mass = "consistent"              # | "lumped"
///     shear = true                     # rotary_inertia, gyroscopic likewise
///     shear_coefficient = "cowper"     # | "hutchinson"
///     stations = [0.05]                # planes that must be nodes
///     ross_file = "rotor.toml"         # shaft, disks and bearings as saved by ROSS, instead of
///     tables [rotor.materials.mysteel]        # E, rho, nu; built in: steel, aluminium, titanium
///     [[rotor.section]]                # left to right; z0 = end of the section before, unless
///     given length = 0.1 od = 0.02                        # id, od_right, id_right, damping_mass,
///     damping_stiffness, name material = "steel"               # or E, rho, nu
///     [[rotor.sleeve]]                 # mass without stiffness: z0, length, od, id, material or
///     rho
///     [[rotor.disk]]                   # z with mass, inertia_diametral, inertia_polar or with
///     width, od,
///                                      # id, material
///     [[rotor.support]]                # z, k, c or kxx, kxy, kyx, kyy, cxx, ...: analysis only
///
/// z runs along the shaft from its left end (or any origin: z0). Units SI. Every mistake is an
/// InputError with file:line.
#include <vector>

#include "core/base/toml.h"
#include "rotor/beam.h"
#include "rotor/reduction.h"

namespace ambrig {

struct BeamFile {
  BeamDefinition definition;
  int modes = 0;
  std::vector<double> modal_damping;  // one for all modes or one each
};

/// Leaves unknown keys of [rotor] itself to the caller, who may know more of them.
BeamFile ReadBeam(const TomlTable& rotor, std::vector<Tolerance>* tolerances = nullptr);

/// The simulator's rotor.
ReducedRotor BuildReduced(const BeamFile& file);

}  // namespace ambrig
