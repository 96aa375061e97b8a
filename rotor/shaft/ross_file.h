#pragma once
/// The rotor file of ROSS (petrobras/ross, `Rotor.save` and `Rotor.load` of versions 1 to 3): TOML
/// or JSON, one table "Class_tag" per element, whose keys are the arguments of that class. Read:
/// shaft elements (L, idl, odl, idr, odr, n, alpha, beta, material; several at one n are layers),
/// disk elements (n, m, Id, Ip), bearings and seals with coefficients kxx, cxx, ... over the speed
/// [rad/s] (`speed` of version 3, `frequency` of 1 and 2, `w` before). Magnetic bearings become
/// planes (ambrig has its own), and what has no counterpart is named, never dropped silently.
/// Written: only keys that every one of these versions takes, and no `ross_version`, which version
/// 1 takes for an element; versions 2 and 3 then warn that they do not know who wrote the file.
/// ROSS's axes are ours. A sleeve is written as a shaft element of E = 1 Pa and read back as one:
/// ROSS has no other way to say mass without stiffness along a shaft. ROSS knows no lumped mass, so
/// that choice is not in the file.
#include <string>
#include <vector>

#include "rotor/shaft/beam.h"

namespace ambrig {

struct RossPlane {
  std::string name;
  double z = 0;
};

struct RossRotor {
  BeamDefinition definition;
  std::vector<RossPlane> magnetic_bearings;
  // "PointMass_housing", "parameters.alpha": what is not modelled here
  std::vector<std::string> ignored;
};

/// Speed-dependent coefficients are taken at `speed` [rad/s], linear between entries.
/// @throws InputError naming file, element and key.
RossRotor ReadRoss(const std::string& file, double speed = 0);

/// By extension .toml or .json. @throws InputError when the file cannot be written.
void WriteRoss(const BeamDefinition& definition, const std::string& file);

}  // namespace ambrig
