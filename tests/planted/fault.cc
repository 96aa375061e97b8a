// catalogue: PlantedFault
/// Planted by tools/planted_change.py: the current sensor of a coil reads a share of the current.
#include "scenarios/faults/faulted_plant.h"

namespace ambrig {

namespace {
constexpr FaultParameter kParameters[] = {
    {"share", "-", 0, 1, false, false, "of the current", 1, true},
};
}  // namespace

const Fault& PlantedFault() {
  static constexpr Fault fault{
      .kind = "planted-sensor",
      .target = FaultTarget::kCoil,
      .doc = "the sensor reads a share of the current",
      .observer = FaultObserver::kCoilDetector,
      .seen_as = "current-sensor",
      .parameters = kParameters,
      .apply = [](const FaultSpec& f,
                  FaultedPlant& plant) { plant.CoilSensor().gain *= f.Get("share", 1); },
  };
  return fault;
}

}  // namespace ambrig
