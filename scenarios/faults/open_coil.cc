/// A coil or its lead breaks.
#include "scenarios/faults/faulted_plant.h"

namespace ambrig {

const Fault& OpenCoil() {
  static constexpr Fault fault{
      .kind = "open",
      .target = FaultTarget::kCoil,
      .doc = "the current goes to zero within one ADC sample and stays zero",
      .observer = FaultObserver::kCoilDetector,
      .seen_as = "open",
      .apply = [](const FaultSpec&, FaultedPlant& plant) { plant.BreakCoil(); },
  };
  return fault;
}

}  // namespace ambrig
