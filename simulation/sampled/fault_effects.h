#pragma once
/// What a fault does to sensors and bridges, the same in every fidelity; how a coil breaks or
/// shorts is each engine's own. Source: docs/theory/base_model.md section 6.
#include "effects/plant.h"
#include "rig/rig_parameters.h"
#include "scenarios/faults/fault_spec.h"

namespace ambrig {

/// Where a fault sits: a coil of a bearing, or a reading (side 0: x or z, 1: y) of it; -1: not
/// there.
struct FaultPlace {
  std::size_t bearing = 0;
  int coil = -1, side = -1;
};
FaultPlace PlaceOf(const FaultSpec& fault, const RigParameters& rig);

/// Changes the reading or the bridge; `current`: of the coil now [A]. True when a bridge changed,
/// so that its voltages must be set again.
bool ApplyToPlant(const FaultSpec& fault, const FaultPlace& place, double current,
                  BearingPlant& plant);

}  // namespace ambrig
