/// Friction of one auxiliary bearing, other than in the rig file (lubricant lost, coating worn).
/// friction >= 0 is the coefficient itself. A negative value is minus a fraction of the rig's own,
/// so that -1 is exactly "as in the rig" (1 * mu = mu, bit for bit) and the parameter has no jump.
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription ContactFriction() {
  EffectDescription d;
  d.id = "contact-friction";
  d.title = "Friction of an auxiliary bearing";
  d.physics =
      "The friction of the auxiliary bearing differs from its nominal value: after a touchdown it "
      "drives\nthe rotor up the race and brakes it; high friction causes backward whirl.";
  d.target = TargetKind::kPlane;
  d.needs.contact = true;
  d.parameters = {{"friction", "-", -1, -1, 2, 0.05, 0.5,
                   "coefficient; negative: minus a fraction of the rig's own"}};
  d.off_when_null = {"friction"};
  d.shows_in = "drops, touch-downs, resting starts";
  d.confused_with = "contact-mount, windage (coast-down)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double friction = e.Value("friction");
    AuxiliaryParameters& p = plant.rotor.auxiliaries()[TargetAuxiliary(e, plant)].parameters;
    p.friction = friction < 0 ? -friction * p.friction : friction;
  };
  return d;
}

}  // namespace ambrig
