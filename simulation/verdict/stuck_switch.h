#pragma once
/// Whether a shaft could have been held against a coil whose switches stay on.
///
/// Its current rises to (U - 2 switch_drop)/R. With the shaft where it is pulled least, at the far side of
/// the clearance, the other coils hold it while  min over 0 (or -i_max) <= i <= i_max of (F(i) - w) d <= 0,
/// d the direction of the pull, w the force that carries the bearing's share of the weight. Beyond the
/// current where that ends no controller keeps the shaft: only cutting the coil's supply would.
/// Ideal iron; loads other than the weight are not counted.
#include <string>

#include "rig/rig_parameters.h"
#include "scenarios/scenario.h"
#include "simulation/record/run_result.h"

namespace ambrig {

struct StuckSwitchLimit {
  double end = 0;   // current that the coil rises to [A]
  double held = 0;  // largest one that the others can hold against [A]; `end` where they always can
};

StuckSwitchLimit LimitOfStuckSwitch(const RigParameters& rig, std::size_t bearing, int coil);

/// A note for each switch stuck on that no controller could have held, in a run whose rotor touched.
void NoteStuckSwitches(const RigParameters& rig, const Scenario& scenario, RunResult& result);

}  // namespace ambrig
