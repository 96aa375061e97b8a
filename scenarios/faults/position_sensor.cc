/// The position sensor of an axis reads something else than the shaft's place.
#include "scenarios/faults/faulted_plant.h"

namespace ambrig {

namespace {

constexpr FaultParameter kPositionSensorParameters[] = {
    {"offset", "m", -1, 1, true, false, "added to the reading"},
    {"stuck", "-", 0, 1, true, true, "the reading is frozen"},
    {"lost", "-", 0, 1, true, true, "the reading is zero"},
};

void ApplyPositionSensor(const FaultSpec& fault, FaultedPlant& plant) {
  SensorFault& f = plant.Reading();
  f.offset += fault.Get("offset", 0);
  f.lost = f.lost || fault.Get("lost", 0) != 0;
  f.stuck = f.stuck || fault.Get("stuck", 0) != 0;
}

}  // namespace

const Fault& PositionSensorFault() {
  static constexpr Fault fault{
      .kind = "position-sensor",
      .target = FaultTarget::kAxis,
      .doc = "the reading is wrong",
      .observer = FaultObserver::kPositionMonitor,
      .seen_as = "position-sensor",
      .parameters = kPositionSensorParameters,
      .must_change = true,
      .apply = ApplyPositionSensor,
  };
  return fault;
}

}  // namespace ambrig
