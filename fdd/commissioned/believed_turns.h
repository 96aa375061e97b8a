#pragma once
/// What is believed to be left of the turns of every coil of a bearing.
#include "actuators/magnetics/lane.h"

namespace ambrig {

struct BelievedTurns {
  Lane share;                    // of the turns [-]; 0: the coil is not judged
  long long taken[kLanes] = {};  // period in which it was set
  bool erred = false;            // a loss of turns turned out to be none
};

}  // namespace ambrig
