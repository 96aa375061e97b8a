/// A current sensor that reads gain * i: the current loop then drives i_set/gain through the coil.
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription CurrentSensorGain() {
  EffectDescription d;
  d.id = "current-sensor-gain";
  d.title = "Gain error of a current sensor";
  d.physics =
      "The sensor reads gain times the current. The current loop removes the error from the "
      "reading: the\ntrue current is set-point over gain, and with it MMF, slope and force of that "
      "coil.";
  d.target = TargetKind::kCoilOrBearing;
  d.parameters = {
      {"gain", "-", 1, 0.2, 5, 0.01, 0.1, "reading over current; typical: distance from 1"}};
  d.off_when_null = {"gain"};
  d.shows_in = "force of clamped records; levitated: cross-talk and changed loop gain of that coil";
  d.confused_with = "turn-mismatch (also changes the ripple), pole area";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double gain = e.Value("gain");
    ForEachTargetCoil(e, plant, [&](BearingPlant& b, int j) {
      b.current_sensor[static_cast<std::size_t>(j)].gain *= gain;
    });
  };
  return d;
}

}  // namespace ambrig
