/// Eddy currents: the flux of a pole diffuses into its laminations, which costs MMF on top of the
/// gap.
///
///   E(s) = R_gap T(s) φ(s),  so without static iron φ = φ_static / (1 + sqrt(j f/cutoff))
///
/// T(s): effects/diffusion_fit.h, relaxations (effects/relaxation_law.h) that vanish at rest. With
/// `path` 0 the half order holds at all frequencies: thick iron. A path gives the laminations their
/// thickness d: below 1/(2 pi τ) they no longer hold the flux back; conductivity σ and
/// path = l_fe/mu_r give τ = σ mu0 mu_r d²/4 and cutoff = g0²/(2 pi τ path²). The MMF that the same
/// iron needs at rest is the effect iron-reluctance. Source: published_values.md 7; Zhu & Knospe
/// 2011 for the half order. Limit: linear iron.
#include <cmath>

#include "effects/coil_targets.h"
#include "effects/diffusion_fit.h"
#include "effects/effect.h"
#include "effects/relaxation_law.h"

namespace ambrig {

EffectDescription EddyCurrents() {
  EffectDescription d;
  d.id = "eddy-currents";
  d.title = "Eddy currents in the iron";
  d.physics =
      "Changing flux induces currents in the laminations that oppose it; it diffuses in with the "
      "square\nroot of time: force and inductance fall by 10 dB a decade, phase tends to -45 "
      "degrees.";
  d.target = TargetKind::kBearing;
  d.acts_on = kOnIron;
  d.parameters = {
      {"cutoff", "Hz", kInfinity, 1, kInfinity, 300, 3e4,
       "frequency at which the half-order drop equals the gap's"},
      {"path", "m", 0, 0, 1e-3, 5e-6, 5e-5, "iron length over mu_r; 0: half order down to rest"}};
  d.vanishing_order = 0.5;
  d.off_when_null = {"cutoff"};
  d.shows_in = "current ripple and steps (steep, then slow), force of fast excitation; not at rest";
  d.confused_with =
      "loop-delay (phase in proportion to f), leakage and gap (seen by the ripple), "
      "iron-reluctance";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    if (!std::isfinite(e.Value("cutoff"))) return;
    BearingPlant& b = TargetBearing(e, plant);
    const double gap = GapReluctanceOf(b), path = e.Value("path") * b.lanes.reluctance.per_metre;
    const DiffusionFit fit = FitDiffusion(e.Value("cutoff"), path / gap);
    Relaxations<kDiffusionPoles> r;
    for (int k = 0; k < kDiffusionPoles; ++k) {
      r.pole[k] = fit.pole[k];
      r.weight[k] = gap * fit.residue[k];
    }
    r.tail = gap * fit.tail;
    b.laws.push_back(MakeRelaxationLaw(r));
  };
  return d;
}

}  // namespace ambrig
