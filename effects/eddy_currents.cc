/// Eddy currents: the flux of a pole diffuses into its laminations, which costs MMF on top of the
/// gap.
///
///   E(s) = R_gap T(s) φ(s),  so without static iron φ = φ_static / (1 + sqrt(j f/cutoff))
///
/// T(s): effects/diffusion_fit.h, relaxations (effects/relaxation_state.h) that vanish at rest. With `path` 0 the half order holds at all frequencies: thick iron. A path gives the
/// laminations their thickness d: below 1/(2 pi τ) they no longer hold the flux back; conductivity
/// σ and path = l_fe/mu_r give τ = σ mu0 mu_r d²/4 and cutoff = g0²/(2 pi τ path²). The MMF that
/// the same iron needs at rest is the effect iron-reluctance. Source: published_values.md 7; Zhu &
/// Knospe 2011 for the half order. Limit: linear iron.
#include <cmath>
#include <memory>

#include "effects/coil_targets.h"
#include "effects/diffusion_fit.h"
#include "effects/effect.h"
#include "effects/relaxation_state.h"

namespace ambrig {

namespace {

using EddyState = RelaxationState<kDiffusionPoles>;
template <class V>
using EddyKernel = RelaxationKernel<V, kDiffusionPoles>;
AMBRIG_LAW_LANES(Eddy)
AMBRIG_LAW_COMMIT(Eddy)

class EddyLaw final : public FluxLaw {
 public:
  /// `gap`: R_gap, rotor centred [1/H].
  EddyLaw(double cutoff, double rho, double gap)
      : fit_(FitDiffusion(cutoff, rho)), tail_(gap * fit_.tail) {
    for (int k = 0; k < kDiffusionPoles; ++k) weight_[k] = gap * fit_.residue[k];
  }

  bool linear() const override { return true; }

  void SetStep(double h) override {
    if (h == h_) return;
    h_ = h;
    state_.SetStep(fit_.pole, weight_, tail_, h);
  }

  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    EddyDrop(state_, phi, drop, slope);
  }
  void Steady(const Lane&, Lane*, Lane*) const override {}
  void Commit(const Lane& phi) override { EddyCommit(state_, phi); }
  int RunSamples(const LawLoop& loop, int k, int count) override {
    return EddyLoop(state_, loop, k, count);
  }
  void Settle(const Lane& phi) override { state_.Settle(phi); }

 private:
  DiffusionFit fit_;
  double weight_[kDiffusionPoles] = {};  // of the relaxations [1/H]
  double tail_;                          // [s/H]
  double h_ = 0;
  EddyState state_;
};

}  // namespace

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
  d.off_when_null = {"cutoff"};
  d.shows_in = "current ripple and steps (steep, then slow), force of fast excitation; not at rest";
  d.confused_with =
      "loop-delay (phase in proportion to f), leakage and gap (seen by the ripple), "
      "iron-reluctance";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    if (!std::isfinite(e.Value("cutoff"))) return;
    BearingPlant& b = TargetBearing(e, plant);
    const double gap = GapReluctanceOf(b), path = e.Value("path") * b.lanes.reluctance.per_metre;
    b.laws.push_back(std::make_unique<EddyLaw>(e.Value("cutoff"), path / gap, gap));
  };
  return d;
}

}  // namespace ambrig
