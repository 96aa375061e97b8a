#pragma once
/// Whether the commissioning that a run would use was learnt on the machine that the rig file
/// describes. Its nominal values are compared where the file is read; here, what the maker does not
/// know of it: calibrated values, effects, the unit. Those of the file count, not what a campaign
/// makes of them.
#include "rig/parameters/machine_identity.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Of the machine in a rig file; not known where there is no such file.
MachineIdentity MachineOfFile(const std::string& rig_file);

/// That the commissioning is of another machine, and in what that differs, in one sentence; empty:
/// it is not, or there is none. Such a machine counts as not commissioned.
std::string OtherMachineNote(const RigParameters& rig);

}  // namespace ambrig
