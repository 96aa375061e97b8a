/// Eddy currents: the flux of a pole diffuses into its laminations, which costs MMF on top of the
/// gap.
///
///   E(s) = R_gap T(s) φ(s),  so without static iron φ = φ_static / (1 + sqrt(j f/cutoff))
///
/// T(s): effects/diffusion_fit.h. With a linear flux over a step of h the relaxations are exact:
///   e_k' = r_k φ' - p_k e_k :   e_k <- a_k e_k + b_k Δφ
///   a_k = exp(-p_k h),  b_k = r_k (1 - a_k)/(p_k h)
/// E = Σ e_k + tail Δφ/h is linear in the flux at the end (one round of Newton) and vanishes at
/// rest. With `path` 0 the half order holds at all frequencies: thick iron. A path gives the
/// laminations their thickness d: below 1/(2 pi τ) they no longer hold the flux back; conductivity
/// σ and path = l_fe/mu_r give τ = σ mu0 mu_r d²/4 and cutoff = g0²/(2 pi τ path²). The MMF that
/// the same iron needs at rest is the effect iron-reluctance. Source: published_values.md 7; Zhu &
/// Knospe 2011 for the half order. Limit: linear iron.
#include <array>
#include <cmath>
#include <memory>

#include "actuators/magnetics/lane_vector.h"
#include "effects/coil_targets.h"
#include "effects/diffusion_fit.h"
#include "effects/effect.h"

namespace ambrig {

namespace {

using V = LaneVector;

/// Coefficients of a step, per gap reluctance.
struct StepCoefficients {
  double a[kDiffusionPoles] = {}, b[kDiffusionPoles] = {};
  double slope = 0;  // Σ b_k + tail/h
};

struct States {
  Lane e[kDiffusionPoles];  // R_gap e_k [A]
  Lane phi;                 // committed [Wb]
  Lane base;                // drop of the next step less slope * φ [A]
};

AMBRIG_WIDE void AdvanceEddy(const StepCoefficients& c, double gap, const double* phi, States& s) {
  const V now = Load(phi), change = (now - Load(s.phi.v)) * gap;
  V kept;
  for (int k = 0; k < kDiffusionPoles; ++k) {
    const V e = Load(s.e[k].v) * c.a[k] + change * c.b[k];
    Store(s.e[k].v, e);
    kept += e * c.a[k];
  }
  Store(s.phi.v, now);
  Store(s.base.v, kept - now * (gap * c.slope));
}

AMBRIG_WIDE void AddEddyDrop(const double* base, double tangent, const double* phi, double* drop,
                             double* slope) {
  Store(drop, Load(drop) + Load(base) + Load(phi) * tangent);
  Store(slope, Load(slope) + tangent);
}

class EddyLaw final : public FluxLaw {
 public:
  EddyLaw(double cutoff, double rho, double gap) : fit_(FitDiffusion(cutoff, rho)), gap_(gap) {}

  bool linear() const override { return true; }

  void SetStep(double h) override {
    if (h == h_) return;
    h_ = h;
    step_.slope = fit_.tail / h;
    for (int k = 0; k < kDiffusionPoles; ++k) {
      const double x = fit_.pole[k] * h;
      step_.a[k] = std::exp(-x);
      step_.b[k] = fit_.residue[k] * -std::expm1(-x) / x;
      step_.slope += step_.b[k];
    }
    Rebase();
  }

  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    AddEddyDrop(states_.base.v, gap_ * step_.slope, phi.v, drop->v, slope->v);
  }

  void Steady(const Lane&, Lane*, Lane*) const override {}

  void Commit(const Lane& phi) override { AdvanceEddy(step_, gap_, phi.v, states_); }

  void Settle(const Lane& phi) override {
    for (Lane& e : states_.e) e = Lane{};
    states_.phi = phi;
    Rebase();
  }

 private:
  void Rebase() {
    for (int j = 0; j < kLanes; ++j) {
      double kept = 0;
      for (int k = 0; k < kDiffusionPoles; ++k) kept += step_.a[k] * states_.e[k][j];
      states_.base[j] = kept - gap_ * step_.slope * states_.phi[j];
    }
  }

  DiffusionFit fit_;
  double gap_;  // R_gap, rotor centred [1/H]
  double h_ = 0;
  StepCoefficients step_;
  States states_;
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
