#pragma once
/// Commands of a scenario that ran with another size, each by itself, told by the controller's
/// program: its answer is linear in the size of every excitation.
#include <string>
#include <vector>

#include "discovery/data_gate/command_replay.h"

namespace ambrig {

struct CommandSizes {
  std::vector<double> of_excitations;  // what ran over what the scenario states [-]
  double left = 1;                     // share of the program's error (rms) that they leave
};

/// The sizes that leave the least error of the controller's program. An excitation that the program
/// does not see, of a coil or of no size, keeps 1. `data`: readings and set-points at the
/// controller's rate, of which `replay` is.
CommandSizes FindCommandSizes(const RigParameters& rig, const Scenario& scenario,
                              const BridgedRecord& data, const CommandReplay& replay);

/// "its multisine at B.y was 0.625 times what the scenario says", of the sizes that differ; ""
/// where none does.
std::string CommandSizesText(const Scenario& scenario, const std::vector<double>& sizes);

}  // namespace ambrig
