/// Eddy currents as a sum of relaxations: what `ambrig refine` writes where eddy-currents was
/// named.
///
///   M(s) = R_gap Σ r_k s/(s + p_k) φ(s) + R' path φ(s),   r_k >= 0,  p_k = 2 pi (16 Hz .. 500 kHz)
///
/// ten corner frequencies half a decade apart, so that any lamination, plate or solid core is met
/// within a few per cent; passive by construction, because every term is a resistance beside an
/// inductance. At rest only `path` is left (the iron's own reluctance). Steps:
/// effects/relaxation_law.h.
#include <cmath>

#include "core/math/constants.h"
#include "effects/coil_targets.h"
#include "effects/effect.h"
#include "effects/law_tables.h"
#include "effects/relaxation_law.h"

namespace ambrig {

EffectDescription EddyImpedance() {
  EffectDescription d;
  d.id = "eddy-impedance";
  d.title = "Eddy currents as a sum of relaxations";
  d.physics =
      "Changing flux costs MMF by ten relaxations of fixed corner frequencies, half a decade "
      "apart, and free\nsizes: any shape of lamination or core. Written by `ambrig refine`.";
  d.target = TargetKind::kBearing;
  d.acts_on = kOnIron;
  d.users_own = true;
  d.parameters = {{"path", "m", 0, 0, 1e-2, 2e-5, 5e-5, "iron path at rest over mu_r, per gap"}};
  d.off_when_null = {"path"};
  for (int k = 0; k < kRelaxations; ++k) {
    d.parameters.push_back({"r" + std::to_string(k + 1), "-", 0, 0, 1e4, 0.05, 0.1,
                            "relaxation at " + std::to_string(std::lround(RelaxationFrequency(k))) +
                                " Hz, of the gap's reluctance"});
    d.off_when_null.push_back(d.parameters.back().name);
  }
  d.shows_in = "current ripple and steps (steep, then slow), force of fast excitation";
  d.confused_with = "nothing that refine proposes: the effect is named before its shape is fitted";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    if (e.IsNull()) return;
    BearingPlant& b = TargetBearing(e, plant);
    const double gap = GapReluctanceOf(b);
    Relaxations<kRelaxations> r;
    for (int k = 0; k < kRelaxations; ++k) {
      r.pole[k] = 2 * kPi * RelaxationFrequency(k);
      r.weight[k] = e.values[static_cast<std::size_t>(k) + 1] * gap;
    }
    r.rest = e.Value("path") * b.lanes.reluctance.per_metre;
    b.laws.push_back(MakeRelaxationLaw(r));
  };
  return d;
}

}  // namespace ambrig
