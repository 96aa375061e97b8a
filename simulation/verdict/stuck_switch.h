#pragma once
/// Whether a shaft could have been held against a coil whose switches stay on.
///
/// Its current rises to (U - 2 switch_drop)/R. The other coils hold the shaft at a place r while
///   min over 0 (or -i_max) <= i <= i_max of (F(i, r) - w) d <= 0
/// d the direction of the pull, w the force that carries the bearing's share of the weight. This
/// is asked with the shaft centred, and at the far side of the clearance, where most coils pull it
/// least: beyond that current no controller keeps the shaft, only cutting the coil's supply would.
/// (A coil on opposite poles pulls the other way there: no bound is known.) Ideal iron; loads other
/// than the weight are not counted.
#include <string>

#include "rig/parameters/rig_parameters.h"
#include "scenarios/scenario.h"
#include "simulation/record/run_result.h"

namespace ambrig {

struct StuckSwitchLimit {
  double end = 0;  // current that the coil rises to [A]
  // Largest currents that the others can hold against, with the shaft centred and at the far
  // side [A]; `end` where they always can.
  double centred = 0, far = 0;
};

StuckSwitchLimit LimitOfStuckSwitch(const RigParameters& rig, std::size_t bearing, int coil);

/// A note for each switch stuck on that the other coils cannot hold at the centre, in a
/// run whose rotor touched.
void NoteStuckSwitches(const RigParameters& rig, const Scenario& scenario, RunResult& result);

}  // namespace ambrig
