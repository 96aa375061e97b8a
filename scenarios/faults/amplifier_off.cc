/// The gate drivers of a coil's bridge fail.
#include "core/base/parameters.h"
#include "scenarios/faults/faulted_plant.h"

namespace ambrig {

namespace {
constexpr FaultParameter kAmplifierOffParameters[] = {
    {"duration", "s", 0, kInfinity, false, false, "inf (default): for good"},
};
}  // namespace

const Fault& AmplifierOff() {
  static constexpr Fault fault{
      .kind = "amplifier-off",
      .target = FaultTarget::kCoil,
      .doc = "both switches stay open, the diodes end the current",
      .observer = FaultObserver::kCoilDetector,
      .seen_as = "amplifier-off",
      .parameters = kAmplifierOffParameters,
      .apply = [](const FaultSpec&, FaultedPlant& plant) { plant.Bridge().off = true; },
      .duration = [](const FaultSpec& f) { return f.Get("duration", kInfinity); },
      .end = [](FaultedPlant& plant) { plant.Bridge().off = false; },
  };
  return fault;
}

}  // namespace ambrig
