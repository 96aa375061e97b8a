/// The switches of a coil's bridge no longer open.
#include "scenarios/faults/faulted_plant.h"

namespace ambrig {

const Fault& SwitchStuckOn() {
  static constexpr Fault fault{
      .kind = "switch-stuck-on",
      .target = FaultTarget::kCoil,
      .doc = "the bridge applies the full bus voltage permanently",
      .observer = FaultObserver::kCoilDetector,
      .seen_as = "switch-stuck-on",
      .apply = [](const FaultSpec&, FaultedPlant& plant) { plant.Bridge().stuck_on = true; },
  };
  return fault;
}

}  // namespace ambrig
