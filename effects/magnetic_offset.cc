/// The magnetic centre is not the sensor's zero: the gaps see the shaft at (x - dx, y - dy).
/// Force on a shaft at the sensors' zero: -ks (dx, dy), ks > 0 the negative stiffness, carried by
/// the static current i0 d/g0 (docs/theory/published_values.md 7).
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription MagneticOffset() {
  EffectDescription d;
  d.id = "magnetic-offset";
  d.title = "Magnetic centre off the sensor's zero";
  d.physics =
      "The magnetic centre is offset from the sensors' zero: with the shaft at zero the gaps "
      "differ, and\nthe bearing exerts the negative stiffness times the offset; the static current "
      "grows with the bias.";
  d.target = TargetKind::kBearing;
  d.parameters = {{"dx", "m", 0, -1e-3, 1e-3, 5e-6, 5e-5, "magnetic centre along x (thrust: z)"},
                  {"dy", "m", 0, -1e-3, 1e-3, 5e-6, 5e-5, "magnetic centre along y"}};
  d.off_when_null = {"dx", "dy"};
  d.shows_in =
      "clamped records (force at equal currents); levitated: static difference of opposite "
      "currents";
  d.confused_with =
      "constant-load (does not grow with the bias), sensor-offset, current-sensor-offset";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    BearingPlant& b = TargetBearing(e, plant);
    b.offset_x += e.Value("dx");
    b.offset_y += e.Value("dy");
  };
  return d;
}

}  // namespace ambrig
