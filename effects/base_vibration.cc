/// The floor shakes: acceleration (cx cos + sx sin, cy cos + sy sin)(2 pi f t) [m/s2], t the
/// record's time. In coordinates that move with the stator the rotor sees its negative. With a
/// base-mode the floor moves the base, and the base the rest.
#include <cmath>

#include "core/math/constants.h"
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription BaseVibration() {
  EffectDescription d;
  d.id = "base-vibration";
  d.title = "Vibration of the floor";
  d.physics =
      "A machine nearby shakes the floor at a fixed frequency: stator and sensors move under the "
      "rotor,\n"
      "which sees the negative of the floor's acceleration, at all planes alike.";
  d.target = TargetKind::kRig;
  d.needs.levitation = true;
  d.tone = true;
  d.parameters = {{"frequency", "Hz", 25, 0.1, 5e3, 10, 200, "of the floor"},
                  {"cx", "m/s2", 0, -1e3, 1e3, 0.02, 2, "along x, cosine at t = 0"},
                  {"sx", "m/s2", 0, -1e3, 1e3, 0.02, 2, "along x, sine"},
                  {"cy", "m/s2", 0, -1e3, 1e3, 0.02, 2, "along y, cosine at t = 0"},
                  {"sy", "m/s2", 0, -1e3, 1e3, 0.02, 2, "along y, sine"}};
  d.off_when_null = {"cx", "sx", "cy", "sy"};
  d.shows_in =
      "every levitated record: a line that does not move with the speed, in phase at all planes";
  d.confused_with = "sensor-hum (one plane, x and y alike), unbalance at that very speed";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double w = 2 * kPi * e.Value("frequency");
    const double cx = e.Value("cx"), sx = e.Value("sx"), cy = e.Value("cy"), sy = e.Value("sy");
    AddForceTerm(plant, [=](const MotionState& m, RotorForces& forces) {
      const double c = std::cos(w * m.t), s = std::sin(w * m.t);
      forces.base_ax += cx * c + sx * s;
      forces.base_ay += cy * c + sy * s;
    });
  };
  return d;
}

}  // namespace ambrig
