/// A current sensor that reads i + offset: the current loop then drives i_set - offset.
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription CurrentSensorOffset() {
  EffectDescription d;
  d.id = "current-sensor-offset";
  d.title = "Offset of a current sensor";
  d.physics =
      "The sensor adds a constant to the current. The current loop removes the offset from "
      "the\nreading; the coil carries that much less, which causes a static force that grows with "
      "the bias.";
  d.target = TargetKind::kCoilOrBearing;
  d.parameters = {{"offset", "A", 0, -100, 100, 0.01, 0.2, "reading minus current"}};
  d.off_when_null = {"offset"};
  d.shows_in = "force of clamped records; levitated: static difference between opposite set-points";
  d.confused_with = "magnetic-offset, constant-load, amplifier-offset";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double offset = e.Value("offset");
    ForEachTargetCoil(e, plant, [&](BearingPlant& b, int j) {
      b.current_sensor[static_cast<std::size_t>(j)].offset += offset;
    });
  };
  return d;
}

}  // namespace ambrig
