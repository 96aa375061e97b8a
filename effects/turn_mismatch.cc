/// One coil has ratio times the turns of the drawing: flux linkage and MMF in proportion, its
/// resistance too (same wire), its leakage inductance with the square.
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription TurnMismatch() {
  EffectDescription d;
  d.id = "turn-mismatch";
  d.title = "Coil whose number of turns differs from the nominal one";
  d.physics =
      "One coil was wound with more or fewer turns: its MMF and linkage scale with the ratio, its\n"
      "resistance with the ratio, its leakage inductance with the ratio squared.";
  d.target = TargetKind::kCoil;
  d.parameters = {
      {"ratio", "-", 1, 0.3, 2, 0.02, 0.2, "turns over the drawing's; typical: distance from 1"}};
  d.off_when_null = {"ratio"};
  d.shows_in = "current ripple and force of one coil, clamped or levitated with excitation";
  d.confused_with =
      "current-sensor-gain of that coil (force only, no change of slope), partial short";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double ratio = e.Value("ratio");
    ForEachTargetCoil(e, plant, [&](BearingPlant& b, int j) {
      b.lanes.n[j] *= ratio;
      b.lanes.leakage[j] *= ratio * ratio;
      b.lanes.resistance[j] *= ratio;
      b.base_resistance[j] *= ratio;
    });
  };
  return d;
}

}  // namespace ambrig
