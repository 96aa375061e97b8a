#pragma once
/// Blocks of rows that a logger lost within a record, told by the commands: behind each block they
/// come earlier than the scenario says, while the controller's program goes on as before.
#include <cstddef>
#include <vector>

#include "discovery/data_gate/command_replay.h"

namespace ambrig {

struct LostBlock {
  std::size_t row = 0;   // first row behind the block
  std::size_t rows = 0;  // that are missing
};

struct LostBlocks {
  std::vector<LostBlock> blocks;  // in their order
  double left = 1;                // share of the program's error (rms) that they leave
};

/// The blocks whose loss leaves the least error of the controller's program, each of which pays for
/// itself. `replay`: of a record at the controller's `rate` [Hz]. The commands may be late or early
/// by the rows that a fit may move them.
LostBlocks FindLostBlocks(const CommandReplay& replay, double rate);

}  // namespace ambrig
