#pragma once
/// The identity of the machine that a rig file describes (rig/parameters/machine_identity.h).
#include "rig/parameters/machine_identity.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Of the rig as its file gives it. What moves the shaft alone does not count: its motion is
/// measured.
MachineIdentity IdentityOf(const RigParameters& rig);

/// In which parts a bearing of two machines differs, in words: "effects (eddy-currents at A)";
/// empty: in none, or one of the two is not known.
std::string DifferenceOf(const MachineIdentity& learnt, const MachineIdentity& now,
                         const std::string& bearing);

}  // namespace ambrig
