/// Cross-coupled stiffness of a seal or impeller:  fx = -k y,  fy = +k x  on the rotor, the
/// opposite on the stator. k > 0 drives the forward whirl: unstable once k > c w of the whirl's
/// mode (docs/theory/published_values.md 7; Alford k = beta T/(D h), 1e3 to 1e7 N/m).
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription CrossCoupling() {
  EffectDescription d;
  d.id = "cross-coupling";
  d.title = "Cross-coupled stiffness (seal, impeller)";
  d.physics =
      "The fluid in a seal or impeller exerts a force perpendicular to the displacement: the "
      "forward\nwhirl gains energy, the backward whirl loses it.";
  d.target = TargetKind::kPlane;
  d.needs.levitation = true;
  d.acts_on = kOnRadial | kOnStator;
  d.parameters = {{"stiffness", "N/m", 0, -1e8, 1e8, 5e3, 2e5, "k of fx = -k y, fy = +k x"}};
  d.at_stations = true;
  d.off_when_null = {"stiffness"};
  d.shows_in = "force excitation: the other axis answers; forward whirl less damped than backward";
  d.confused_with = "sensor-rotation (same at standstill, no force of its own), rotating-damping";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const PlaneMap map = TargetForcePlane(e, plant);
    const double k = e.Value("stiffness");
    AddForceTerm(plant, [=](const MotionState& m, RotorForces& forces) {
      const double fx = -k * map.Y(m.q), fy = k * map.X(m.q);
      map.AddForce(fx, fy, forces.Q);
      forces.stator_x += fx;
      forces.stator_y += fy;
    });
  };
  return d;
}

}  // namespace ambrig
