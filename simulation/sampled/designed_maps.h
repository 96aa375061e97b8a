#pragma once
/// The maps from forces to currents that a controller is designed again for after
/// coils have failed.
///
/// The linear plant of a synthesis has healthy coils. A coil that has kept the share s of its turns
/// and carries i makes the ampere-turns of a healthy one with s i: its row of W counts s times. A
/// force-by-force allocation makes up the stiffness of the healthy bearing by itself
/// (faulttolerance/redistribution/inverse_allocation.h), so that the bearing counts as healthy.
#include <vector>

#include "control/current/control_action.h"
#include "rig/nominal_rig.h"

namespace ambrig {

/// Takes the change into `maps`, one per bearing of the rig; empty ones are those
/// of healthy bearings.
void TakeIntoDesign(const NominalRig& nominal, const ReplaceMap& change,
                    std::vector<CurrentMap>* maps);

}  // namespace ambrig
