/// Flux that bulges out of the gap: pole area A (1 + coefficient g/g0), so
/// R(g) = g / (mu0 A (1 + coefficient g/g0)). By virtual work the pull is (1/2) phi² dR/dg: at a
/// given current the fringing flux adds to the inductance, hardly to the pull. Where the pole's
/// edges carry the flux so that it pulls like the rest, the pull is phi²/(2 mu0 A); `face_pull` is
/// that share.
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription Fringing() {
  EffectDescription d;
  d.id = "fringing";
  d.title = "Fringing of the gap field";
  d.physics =
      "Flux fringes at the edges of the pole, so the effective pole area grows with the gap:\nA (1 "
      "+ coefficient g/g0). Force falls less steeply with the gap than 1/g³.";
  d.target = TargetKind::kBearing;
  d.acts_on = kOnIron;
  d.parameters = {
      {"coefficient", "-", 0, -0.5, 2, 0.01, 0.15, "growth of the area per nominal gap"},
      {"face_pull", "-", 0, 0, 1, 0.3, 1, "share of the fringing flux that pulls like the rest"}};
  d.off_when_null = {"coefficient"};
  d.shows_in = "clamped current steps at several rotor positions";
  d.confused_with =
      "a larger pole area, more turns; told apart by how force and slope depend on position";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    GapReluctance& reluctance = TargetBearing(e, plant).lanes.reluctance;
    reluctance.fringing = e.Value("coefficient");
    reluctance.face_pull = e.Value("face_pull");
  };
  return d;
}

}  // namespace ambrig
