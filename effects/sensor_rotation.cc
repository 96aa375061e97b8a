/// Sensor axes turned against the bearing's:  x' = x cos a + y sin a,  y' = -x sin a + y cos a.
/// The loop gains an antisymmetric stiffness k sin a at any speed (published_values.md 7).
#include <cmath>

#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription SensorRotation() {
  EffectDescription d;
  d.id = "sensor-rotation";
  d.title = "Sensors mounted at an angle to the magnets";
  d.physics =
      "Both sensors of a plane are turned by an angle: each axis reads part of the other one.\n"
      "The control force then has a cross part: one whirl direction loses damping, at any speed.";
  d.target = TargetKind::kPlane;
  d.acts_on = kOnRadial | kOnStator;
  d.parameters = {
      {"angle", "rad", 0, -1.6, 1.6, 0.01, 0.1, "sensor axes against the bearing's, x towards y"}};
  d.off_when_null = {"angle"};
  d.shows_in = "force excitation: the other axis of the plane answers; also at standstill";
  d.confused_with =
      "cross-coupling (a force: shows in the sum of forces), gyroscopics (grow with speed)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double c = std::cos(e.Value("angle")), s = std::sin(e.Value("angle"));
    AddMap(TargetPlane(e, plant).sensor, ReadingStage::kAxes,
           [c, s](const MotionState&, double* x, double* y) {
             const double u = *x, v = *y;
             *x = u * c + v * s;
             *y = -u * s + v * c;
           });
  };
  return d;
}

}  // namespace ambrig
