/// A sensor that reads `offset` with the shaft at zero:  reading = displacement + offset, after the
/// gain (published_values.md 7). The integrator moves the shaft by -offset; gaps and static
/// currents follow.
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription SensorOffset() {
  EffectDescription d;
  d.id = "sensor-offset";
  d.title = "Offset of a position sensor";
  d.physics =
      "The sensor of one axis reads a constant with the shaft centred: the controller holds the "
      "shaft\n"
      "off centre, where the negative stiffness of the bearing asks for other static currents.";
  d.target = TargetKind::kAxis;
  d.parameters = {{"offset", "m", 0, -1e-2, 1e-2, 2e-6, 5e-5, "reading with the shaft at zero"}};
  d.off_when_null = {"offset"};
  d.shows_in =
      "static currents of levitated records; clamped records show it as a constant reading";
  d.confused_with = "magnetic-offset, constant-load, current-sensor-offset";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double offset = e.Value("offset");
    const int side = TargetSide(e);
    AddMap(TargetPlane(e, plant).sensor, ReadingStage::kOffset,
           [offset, side](const MotionState&, double* x, double* y) {
             *(side == 0 ? x : y) += offset;
           });
  };
  return d;
}

}  // namespace ambrig
