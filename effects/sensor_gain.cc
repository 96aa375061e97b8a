/// A sensor whose gain is not that of its data sheet:  reading = gain * displacement
/// (published_values.md 7). Scales the stiffness and damping that the controller makes on that
/// axis.
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription SensorGain() {
  EffectDescription d;
  d.id = "sensor-gain";
  d.title = "Gain error of a position sensor";
  d.physics =
      "The sensor of one axis reads gain times the displacement; offsets are not scaled.\n"
      "The position loop of that axis becomes stiffer or softer by the same factor.";
  d.target = TargetKind::kAxis;
  d.parameters = {{"gain", "-", 1, 0.01, 100, 0.01, 0.2, "reading over displacement"}};
  d.off_when_null = {"gain"};
  d.shows_in = "force excitation of that axis; any record that moves, hardly one at rest";
  d.confused_with =
      "pole area or gap of that bearing (they change the static force too), sensor-rotation";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double gain = e.Value("gain");
    const int side = TargetSide(e);
    AddMap(
        TargetPlane(e, plant).sensor, ReadingStage::kGain,
        [gain, side](const MotionState&, double* x, double* y) { *(side == 0 ? x : y) *= gain; });
  };
  return d;
}

}  // namespace ambrig
