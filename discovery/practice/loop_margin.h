#pragma once
/// Whether a sampled machine is one that somebody would run: records of a loop at the edge of
/// stability show its initial state and its noise, whatever else is in it.
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Levitated at rest, the position loops are stable, and stay so when the gain of any one of them
/// changes by a tenth. Effects of the rig do not count. @throws InputError that names the axis
void RequireLoopMargin(const RigParameters& rig);

}  // namespace ambrig
