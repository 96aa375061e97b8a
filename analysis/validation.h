#pragma once
/// Published rotors and rigs beside what this program computes for them. A validation file holds
/// the rotor (tables of rotor/shaft/beam_file.h, or a rigid one), or names a rig, and the published
/// figures:
///
///     name = "Friswell 5.9.1"
///     source = "Friswell et al., Dynamics of Rotating Machines, 2010"
///     trust = "published"            # | "computed" by another program | "low": shown,
///       never passed
///     rig = "rig.toml"               # instead of [rotor]: quantities of its bearings
///     [rotor]                        # kind = "beam" or "rigid" (mass, inertia_transverse,
///       inertia_polar)
///     [[loop]]                       # proportional-derivative feedback on a rigid rotor
///     z = 0.2  sensor_z = 0.2  stiffness = 1e5  damping = 100.0  negative = 1e4    # [N/m],
///       [N s/m]
///     [[check]]
///     quantity = "natural frequencies"     # see kQuantities
///     unit = "rad/s"                       # | "Hz" | "rpm", "kg", ...
///     speed_rpm = 4000.0
///     published = [85.39, 87.80]           # eigenvalues: [[re, im], ...]
///     tolerance = 0.005                    # relative, of the largest difference; default 0.5 %
///
/// Further keys of a check: springs = [[z, k, c], ...] (instead of the file's supports), every
/// (take one mode of so many), above (lowest frequency that counts, in the unit), planes (pinned),
/// unbalance = { z, magnitude, at } with speeds_rpm, axis (of a rig), reduced (modes of the
/// reduction, 0: the whole beam), lumped, match = "nearest", note.
#include <string>
#include <vector>

namespace ambrig {

struct ValidationRow {
  std::string name, source, trust, quantity, unit, note, file;
  std::vector<double> published, ours;
  double difference = 0;  // largest relative one [-]
  double tolerance = 0;
  bool low() const { return trust == "low"; }
  bool agrees() const { return difference <= tolerance; }
};

/// All checks of one file. @throws InputError with file:line.
std::vector<ValidationRow> Validate(const std::string& file);

}  // namespace ambrig
