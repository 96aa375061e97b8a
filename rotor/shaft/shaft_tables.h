#pragma once
/// The tables of a shaft's parts: materials, sections and sleeves, disks and supports, each
/// checked as it is read (rotor/shaft/beam_file.h shows them).
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "core/base/toml_checked.h"
#include "rotor/shaft/beam.h"
#include "rotor/shaft/beam_file.h"

namespace ambrig {

using Materials = std::map<std::string, Material>;

inline constexpr Range kPlaceOnShaft{"m", -1e3, 1e3, "place on the shaft axis"};

/// The built-in materials and those of [rotor.materials].
Materials ReadMaterials(const TomlTable& rotor, std::vector<Tolerance>* tolerances);

/// Numbers that decide planes or shapes cannot be moved by a calibration.
void RejectSd(const TomlTable& row, std::initializer_list<const char*> keys,
              const std::vector<Tolerance>* tolerances);

/// What a table was written with.
ShaftTableSource SourceOf(const TomlTable& row);

/// A section (`stiff`) that begins at z0 [m] unless it says otherwise, or a sleeve.
ShaftSection ReadSection(const TomlTable& row, const Materials& materials, bool stiff, double z0,
                         std::vector<Tolerance>* tolerances);
/// `rho` [kg/m3]: set of a disk given by its geometry.
Disk ReadDisk(const TomlTable& row, const Materials& materials, std::vector<Tolerance>* tolerances,
              double* rho);

}  // namespace ambrig
