/// Constant error of the output voltage, and a duty below which nothing comes out (minimum pulse).
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription AmplifierOffset() {
  EffectDescription d;
  d.id = "amplifier-offset";
  d.title = "Offset and dead duty of the amplifier";
  d.physics =
      "The bridge adds a constant voltage to the commanded one, and pulses shorter than a minimum "
      "duty\nare suppressed.";
  d.target = TargetKind::kCoilOrBearing;
  d.parameters = {{"offset", "V", 0, -100, 100, 0.05, 2, "added while the bridge drives the coil"},
                  {"dead_duty", "-", 0, 0, 0.5, 0.02, 0.1, "no pulse below this duty"}};
  d.off_when_null = {"offset", "dead_duty"};
  d.shows_in =
      "open-loop duty records; in closed current loops only transients and the duty itself";
  d.confused_with = "freewheel-drop, switch drops, current-sensor-offset (closed loop)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double offset = e.Value("offset"), dead_duty = e.Value("dead_duty");
    ForEachTargetCoil(e, plant, [&](BearingPlant& b, int j) {
      BridgeImperfection& bridge = b.bridge[static_cast<std::size_t>(j)];
      bridge.voltage_offset += offset;
      bridge.dead_duty = dead_duty;
    });
  };
  return d;
}

}  // namespace ambrig
