// catalogue: PlantedEffect
/// Planted by tools/planted_change.py: a spring from the shaft to the stator, f = -k r.
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription PlantedEffect() {
  EffectDescription d;
  d.id = "planted-spring";
  d.title = "Planted spring";
  d.physics = "A spring pulls the shaft back to the centre of one plane.";
  d.target = TargetKind::kPlane;
  d.acts_on = kOnRadial;
  d.needs.levitation = true;
  d.parameters = {{"stiffness", "N/m", 0, 0, 1e8, 1e4, 5e5, "k of f = -k r"}};
  d.off_when_null = {"stiffness"};
  d.shows_in = "force excitation at low frequency";
  d.confused_with = "side-pull, with the other sign";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const PlaneMap map = TargetForcePlane(e, plant);
    const double k = e.Value("stiffness");
    AddForceTerm(plant, [=](const MotionState& m, RotorForces& forces) {
      map.AddForce(-k * map.X(m.q), -k * map.Y(m.q), forces.Q);
    });
  };
  return d;
}

}  // namespace ambrig
