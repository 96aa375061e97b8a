/// The supply of all amplifiers falls.
#include "core/base/parameters.h"
#include "scenarios/faults/faulted_plant.h"

namespace ambrig {

namespace {
constexpr double kSag = 0.8;  // of the nominal bus, where the file names no voltage
constexpr FaultParameter kBusSagParameters[] = {
    {"voltage", "V", 0, 1e5, true, false,
     "during the sag, below the rig's bus_voltage; default: 0.8 of it", 0, false,
     &AmplifierParameters::bus_voltage},
    {"duration", "s", 0, kInfinity, false, false, "inf (default): for good"},
};
}  // namespace

const Fault& BusSag() {
  static constexpr Fault fault{
      .kind = "bus-sag",
      .target = FaultTarget::kRig,
      .doc = "the supply voltage drops, temporarily or permanently",
      .observer = FaultObserver::kBusMonitor,
      .seen_as = "bus-sag",
      .parameters = kBusSagParameters,
      .apply =
          [](const FaultSpec& f, FaultedPlant& plant) {
            plant.SetBus(f.Get("voltage", kSag * plant.nominal_bus()));
          },
      .duration = [](const FaultSpec& f) { return f.Get("duration", kInfinity); },
      .end = [](FaultedPlant& plant) { plant.SetBus(plant.nominal_bus()); },
  };
  return fault;
}

}  // namespace ambrig
