/// Drag of the gas around the rotor:  torque = -drag Omega |Omega|, felt where the speed is not
/// prescribed (Ip Omega' = torque). Alone it gives Omega = Omega0/(1 + drag Omega0 t/Ip)
/// (docs/theory/published_values.md 7).
#include <cmath>

#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription Windage() {
  EffectDescription d;
  d.id = "windage";
  d.title = "Windage";
  d.physics =
      "The drag of the surrounding gas grows with the square of the speed: the speed of a free "
      "rotor\ndecays hyperbolically.";
  d.target = TargetKind::kRig;
  d.needs.free_speed = true;
  d.parameters = {{"drag", "N m s2", 0, 0, 1, 1e-9, 1e-6, "torque over the square of the speed"}};
  d.off_when_null = {"drag"};
  d.shows_in = "coast-downs only: speed and angle against time";
  d.confused_with = "contact friction during a coast-down";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double drag = e.Value("drag");
    AddForceTerm(plant, [drag](const MotionState& m, RotorForces& forces) {
      forces.torque -= drag * m.Omega * std::abs(m.Omega);
    });
  };
  return d;
}

}  // namespace ambrig
