#pragma once
/// Shafts in files of their own, for converting between ROSS's rotor file and a [rotor] table.
#include <string>
#include <vector>

#include "rotor/shaft/beam_file.h"
#include "rotor/shaft/ross_magnets.h"

namespace ambrig {

/// The shaft of a file of its own: ROSS's (.toml, .json), or a .toml with a [rotor] of kind beam, a
/// rig file among them. `ross`: which one it was; `ignored`: elements of ROSS without a
/// counterpart.
/// With `tolerances`, numbers with an sd as ReadBeam gives them. Magnetic bearings of ROSS go
/// to `magnets`, or, without that, are named among what is ignored.
BeamFile ReadShaft(const std::string& file, bool* ross, std::vector<std::string>* ignored = nullptr,
                   std::vector<Tolerance>* tolerances = nullptr,
                   std::vector<RossMagnet>* magnets = nullptr);

/// A [rotor] that ReadBeam reads back to the same numbers. Materials become E, rho, nu.
std::string BeamText(const BeamFile& file);
/// @throws InputError when the file cannot be written.
void WriteBeam(const BeamFile& file, const std::string& path);

}  // namespace ambrig
