/// Some turns of a coil are shorted among themselves. With a resistance in the short the shorted
/// turns form a closed winding of their own on the same pole; without one they are bypassed.
#include <cmath>

#include "core/base/parameters.h"
#include "scenarios/faults/faulted_plant.h"

namespace ambrig {

namespace {
constexpr FaultParameter kPartialShortParameters[] = {
    {"fraction", "-", 0, 1, false, false, "share of the turns", 0, true},
    {"short_resistance", "ohm", 0, kInfinity, true, false,
     "of the short; inf (default): turns bypassed", kInfinity},
};
}  // namespace

const Fault& PartialShort() {
  static constexpr Fault fault{
      .kind = "partial-short",
      .target = FaultTarget::kCoil,
      .doc = "a fraction of the remaining driven turns is shorted",
      .observer = FaultObserver::kCoilDetector,
      .seen_as = "partial-short",
      .parameters = kPartialShortParameters,
      .apply =
          [](const FaultSpec& f, FaultedPlant& plant) {
            plant.ShortTurns(f.Get("fraction", 0), f.Get("short_resistance", kInfinity));
          },
      .adds_winding =
          [](const FaultSpec& f) { return std::isfinite(f.Get("short_resistance", kInfinity)); },
      .turns_left = [](const FaultSpec& f) { return 1 - f.Get("fraction", 0); },
  };
  return fault;
}

}  // namespace ambrig
