/// Error of the output voltage, constant and in proportion to the current, and a duty below which
/// nothing comes out (minimum pulse). A current loop's integral takes up a constant error at once;
/// what it follows is the part that changes with the current, which a resistance in series is.
#include <algorithm>

#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

namespace {
constexpr double kLeast = 0.01;  // of the winding's resistance
}

EffectDescription AmplifierOffset() {
  EffectDescription d;
  d.id = "amplifier-offset";
  d.title = "Offset, series resistance and dead duty of the amplifier";
  d.physics =
      "The bridge adds a constant voltage to the commanded one, its switches, plugs and leads have "
      "a\nresistance that the winding's does not count, and pulses shorter than a minimum duty are "
      "suppressed.";
  d.target = TargetKind::kCoilOrBearing;
  d.parameters = {{"offset", "V", 0, -100, 100, 0.05, 2, "added while the bridge drives the coil"},
                  {"dead_duty", "-", 0, 0, 0.5, 0.02, 0.1, "no pulse below this duty"},
                  {"resistance", "ohm", 0, -10, 10, 0, 0.3,
                   "in series with the coil, beside the winding's own"}};
  d.off_when_null = {"offset", "dead_duty", "resistance"};
  d.shows_in =
      "open-loop duty records; in closed current loops the duty itself, of the offset transients "
      "only, of the\nresistance every ramp and swing of the current";
  d.confused_with =
      "freewheel-drop, switch drops, current-sensor-offset (closed loop); turn-mismatch, and at a "
      "whole bearing\na larger resistance";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double offset = e.Value("offset"), dead_duty = e.Value("dead_duty"),
                 resistance = e.Value("resistance");
    ForEachTargetCoil(e, plant, [&](BearingPlant& b, int j) {
      BridgeImperfection& bridge = b.bridge[static_cast<std::size_t>(j)];
      bridge.voltage_offset += offset;
      bridge.dead_duty += dead_duty;
      // negative: the drawing's value counts more than is there, but never all of it
      const double whole =
          std::max(b.base_resistance[j] + resistance, kLeast * b.base_resistance[j]);
      b.lanes.resistance[j] = b.base_resistance[j] = whole;
    });
  };
  return d;
}

}  // namespace ambrig
