/// The current sensor of a coil reads something else than the current.
#include "scenarios/faults/faulted_plant.h"

namespace ambrig {

namespace {

constexpr FaultParameter kCurrentSensorParameters[] = {
    {"gain", "-", -100, 100, true, false, "factor on the reading", 1},
    {"offset", "A", -1e4, 1e4, true, false, "added to the reading"},
    {"stuck", "-", 0, 1, true, true, "the reading is frozen"},
};

void ApplyCurrentSensor(const FaultSpec& f, FaultedPlant& plant) {
  CurrentSensor& s = plant.CoilSensor();
  s.gain *= f.Get("gain", 1);
  s.offset += f.Get("offset", 0);
  if (f.Get("stuck", 0) == 0) return;
  s.stuck = true;
  s.stuck_at = plant.Current();
}

}  // namespace

const Fault& CurrentSensorFault() {
  static constexpr Fault fault{
      .kind = "current-sensor",
      .target = FaultTarget::kCoil,
      .doc = "the reading is wrong",
      .observer = FaultObserver::kCoilDetector,
      .seen_as = "current-sensor",
      .parameters = kCurrentSensorParameters,
      .must_change = true,
      .apply = ApplyCurrentSensor,
  };
  return fault;
}

}  // namespace ambrig
