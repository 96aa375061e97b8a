#pragma once
/// The `[rotor]` table of a rig file with kind = "beam":
///
///     [rotor]
///     kind = "beam"
///     modes = 3                        # bending modes kept by the simulator
///     static_correction = true         # residual modes at the magnets beside them (false)
///     modal_damping = 0.002            # ratio of each, or one per mode: [0.002, 0.004]
///     elements_per_section = 4
///     mass = "consistent"              # | "lumped"
///     shear = true                     # rotary_inertia, gyroscopic likewise
///     shear_coefficient = "cowper"     # | "hutchinson"
///     element = "two_node"             # | "three_node": of fourth order with shear, too
///     stations = [0.05]                # planes that must be nodes
///     file = "shaft.json"              # the shaft from a file instead of sections here: one that
///                                      # ROSS saved (.toml, .json) or a [rotor] like this (.toml)
///     [rotor.materials.mysteel]        # E, rho, nu; built in: steel, aluminium, titanium
///     [[rotor.section]]                # left to right; z0 = end of the one before, if not given
///     length = 0.1
///     od = 0.02                        # id, od_right, id_right, damping_mass,
///                                      # damping_stiffness, name
///     material = "steel"               # or E, rho, nu
///     [[rotor.sleeve]]                 # mass without stiffness: z0, length, od, id, material or
///                                      # rho
///     [[rotor.disk]]                   # z with mass, inertia_diametral, inertia_polar, or z with
///                                      # width, od, id, material; name
///     [[rotor.station]]                # name, z: a plane for loads, unbalance and the record
///     [[rotor.support]]                # z, k, c or kxx, kxy, kyx, kyy, cxx, ..., mxx, ..., kzz,
///                                      # czz, mzz; over speed = [rad/s] arrays of them;
///                                      # carries and on: housings by name
///     to = "outer"                     # of a [[rotor.support]]: it is on that shaft, at to_z (z)
///     layers = "joined"                # | "separate": each layer an element, as ROSS has it
///     [[rotor.shaft]]                  # name; two or more: sections, disks, ... say shaft = NAME
///     [[rotor.housing]]                # name, mass or mass_x, mass_y, mass_z
///     [[rotor.point_mass]]             # z, mass or mass_x, mass_y, mass_z
///
/// z runs along the shaft from its left end (or any origin: z0). Units SI. Every mistake is an
/// InputError with file:line.
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/toml.h"
#include "rotor/shaft/beam.h"
#include "rotor/shaft/reduction.h"

namespace ambrig {

/// A plane of the shaft that has a name: a disk's or a station's.
struct ShaftPlane {
  std::string name;
  double z = 0;  // [m]
};

/// What a section, sleeve or disk was written with; empty of ROSS's.
struct ShaftTableSource {
  std::string path;            // "rotor.section[1]"
  std::string material;        // by name, "" without
  std::set<std::string> keys;  // that stand in the table
  double rho = 0;              // of a disk given by its geometry [kg/m3]
};

struct BeamFile;

/// A number with an sd (rotor/shaft/shaft_parameters.h).
struct ShaftParameter {
  std::string path, unit;
  double value = 0, lo = 0, hi = 0;
  std::vector<std::function<void(BeamFile&, double)>> set;  // it and what follows it
};

struct BeamFile {
  BeamDefinition definition;
  std::vector<ShaftPlane> planes;
  int modes = 0;                              // wanted
  bool static_correction = false;             // with residual modes of a rig's magnets
  std::vector<double> modal_damping;          // one for all modes or one each
  std::map<std::string, Material> materials;  // named ones
  // as definition.sections, .disks, .supports
  std::vector<ShaftTableSource> section_sources, disk_sources, support_sources;
  // of the tolerances asked for, in their order
  std::vector<ShaftParameter> parameters;
};

/// Leaves unknown keys of [rotor] itself to the caller, who may know more of them. Numbers with an
/// sd are appended to `tolerances`, each with its ShaftParameter; without `tolerances` an sd is not
/// looked at.
BeamFile ReadBeam(const TomlTable& rotor, std::vector<Tolerance>* tolerances = nullptr);

/// The simulator's rotor, with the residual modes of these planes [m on the file's axis].
ReducedRotor BuildReduced(const BeamFile& file, const std::vector<double>& stations = {});

}  // namespace ambrig
