/// The gate drivers of a coil's bridge fail.
#include "scenarios/faults/faulted_plant.h"

namespace ambrig {

const Fault& AmplifierOff() {
  static constexpr Fault fault{
      .kind = "amplifier-off",
      .target = FaultTarget::kCoil,
      .doc = "both switches stay open, the diodes end the current",
      .observer = FaultObserver::kCoilDetector,
      .seen_as = "amplifier-off",
      .apply = [](const FaultSpec&, FaultedPlant& plant) { plant.Bridge().off = true; },
  };
  return fault;
}

}  // namespace ambrig
