#pragma once
/// The rotor file of ROSS (petrobras/ross, `Rotor.save` and `Rotor.load` of versions 1 to 3): TOML
/// or JSON, one table "Class_tag" per element, whose keys are the arguments of that class. Read:
/// shaft elements (L, idl, odl, idr, odr, n, alpha, beta, material; several at one n are layers),
/// disk elements (n, m, Id, Ip), bearings and seals with coefficients kxx, cxx, ... over the speed
/// [rad/s] (`speed` of version 3, `frequency` of 1 and 2, `w` before), cubic splines between
/// the speeds as there (beyond them ROSS extrapolates, here the end rows hold), point masses, and
/// housings: nodes off the shaft that bearings reach by n_link; further shafts
/// (rotor/shaft/ross_nodes.h) and couplings between them. Magnetic bearings stand apart
/// (rotor/shaft/ross_magnets.h), and what has no counterpart is named with its size,
/// never dropped silently. Written: only keys that every one of these versions takes, and no
/// `ross_version`, which version 1 takes for an element; versions 2 and 3 then warn that they do
/// not know who wrote the file. ROSS's axes are ours. A sleeve is written as a shaft element of
/// E = 1 Pa and read back as one: ROSS has no other way to say mass without stiffness along a
/// shaft. ROSS knows no lumped mass: named, as everything that a writer or a reader cannot carry.
#include <string>
#include <vector>

#include "rotor/shaft/beam.h"
#include "rotor/shaft/ross_magnets.h"

namespace ambrig {

struct RossRotor {
  BeamDefinition definition;
  std::vector<RossMagnet> magnetic_bearings;  // their planes are stations too
  // "torque 5 N m at ShaftElement_7 (element 7)": what is not modelled here
  std::vector<std::string> ignored;
};

/// @throws InputError naming file, element and key.
RossRotor ReadRoss(const std::string& file);

/// By extension .toml or .json; gives what ROSS does not know. Magnetic bearings as
/// MagneticBearingElement, which versions from 2 on load. @throws InputError when the file
/// cannot be written.
std::vector<std::string> WriteRoss(BeamDefinition definition, const std::string& file,
                                   const std::vector<RossMagnet>& magnets = {});

}  // namespace ambrig
