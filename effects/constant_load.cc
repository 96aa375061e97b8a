/// A constant force on the rotor at a plane: belt, tilt, hose. Its reaction goes past the stator.
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription ConstantLoad() {
  EffectDescription d;
  d.id = "constant-load";
  d.title = "Constant load";
  d.physics =
      "A belt, a hose or a tilt of the rig loads the rotor with a constant force: the bearing "
      "carries\nit with static currents that decrease with the bias.";
  d.target = TargetKind::kPlane;
  d.needs.levitation = true;
  d.parameters = {{"fx", "N", 0, -1e6, 1e6, 0.5, 30, "along x"},
                  {"fy", "N", 0, -1e6, 1e6, 0.5, 30, "along y"}};
  d.at_stations = true;
  d.off_when_null = {"fx", "fy"};
  d.shows_in = "levitated records: static currents, set-points; not in clamped ones";
  d.confused_with =
      "magnetic-offset and sensor-offset (grow with the bias), rotor mass, current-sensor-offset";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const PlaneMap map = TargetForcePlane(e, plant);
    const double fx = e.Value("fx"), fy = e.Value("fy");
    AddForceTerm(plant,
                 [=](const MotionState&, RotorForces& forces) { map.AddForce(fx, fy, forces.Q); });
  };
  return d;
}

}  // namespace ambrig
