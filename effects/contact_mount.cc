/// The race of an auxiliary bearing stands on a resilient mount: mass, spring and damper between
/// race and stator in both radial directions. Above 1e12 N/m, four decades over any contact, it is
/// rigid.
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription ContactMount() {
  EffectDescription d;
  d.id = "contact-mount";
  d.title = "Resilient mount of an auxiliary bearing";
  d.physics =
      "The auxiliary bearing sits in a tolerance ring or elastomer: its race yields under the "
      "rotor,\nwhich makes impacts longer and softer and dissipates energy of the rebound.";
  d.target = TargetKind::kPlane;
  d.needs.contact = true;
  d.parameters = {{"stiffness", "N/m", kInfinity, 1, kInfinity, 1e6, 1e8, "of the mount"},
                  {"damping", "N s/m", 0, 0, 1e7, 100, 1e4, "of the mount"},
                  {"mass", "kg", 0.1, 1e-4, 100, 0.05, 1, "race and holder"}};
  d.off_when_null = {"stiffness"};
  d.shows_in =
      "drops, touch-downs, resting starts (the rotor rests lower by its weight over the stiffness)";
  d.confused_with = "contact-friction, contact stiffness and clearance of the rig";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const std::size_t k = TargetAuxiliary(e, plant);
    const double stiffness = e.Value("stiffness");
    if (stiffness < 1e12) plant.rotor.SetMount(k, stiffness, e.Value("damping"), e.Value("mass"));
  };
  return d;
}

}  // namespace ambrig
