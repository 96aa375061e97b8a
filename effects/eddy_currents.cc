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

#include "actuators/magnetics/law_loop.h"
#include "effects/coil_targets.h"
#include "effects/diffusion_fit.h"
#include "effects/effect.h"

namespace ambrig {

namespace {

/// Coefficients of a step and what the flux has left behind.
struct EddyState {
  double a[kDiffusionPoles] = {}, b[kDiffusionPoles] = {};  // b: times R_gap [1/H]
  double ab = 0;                                            // Σ a_k b_k [1/H]
  double slope = 0;                                         // R_gap (Σ b_k + tail/h) [1/H]
  Lane e[kDiffusionPoles];                                  // R_gap e_k [A]
  Lane phi;                                                 // committed [Wb]
  Lane base;  // drop of the next step less slope * φ [A]
};

/// Σ x(k) over the poles, in pairs: no long chain of sums.
template <class F>
[[gnu::always_inline]] inline auto SumOverPoles(const F& x) {
  static_assert(kDiffusionPoles == 8);
  return ((x(0) + x(1)) + (x(2) + x(3))) + ((x(4) + x(5)) + (x(6) + x(7)));
}

template <class V>
class EddyKernel {
 public:
  static constexpr bool kLinear = true;
  [[gnu::always_inline]] explicit EddyKernel(const EddyState& s)
      : state_(s), phi_(LoadAs<V>(s.phi.v)), base_(LoadAs<V>(s.base.v)) {
    for (int k = 0; k < kDiffusionPoles; ++k) e_[k] = LoadAs<V>(s.e[k].v);
  }
  [[gnu::always_inline]] const V& Base() const { return base_; }
  [[gnu::always_inline]] double Slope() const { return state_.slope; }
  [[gnu::always_inline]] void Terms(const V& phi, V* drop, V* slope) const {
    *drop = base_ + phi * state_.slope;
    *slope = state_.slope;
  }
  [[gnu::always_inline]] void Commit(const V& phi) {
    // Σ a_k e_k of the new e_k, in what is known before φ and what is not.
    const auto& a = state_.a;
    const V known =
        SumOverPoles([&](int k) __attribute__((always_inline)) { return e_[k] * (a[k] * a[k]); });
    const V change = phi - phi_;
    for (int k = 0; k < kDiffusionPoles; ++k) e_[k] = e_[k] * a[k] + change * state_.b[k];
    base_ = known + change * state_.ab - phi * state_.slope;
    phi_ = phi;
  }
  [[gnu::always_inline]] void Keep(EddyState* s) const {
    for (int k = 0; k < kDiffusionPoles; ++k) Store(s->e[k].v, e_[k]);
    Store(s->phi.v, phi_);
    Store(s->base.v, base_);
  }

 private:
  const EddyState& state_;
  V e_[kDiffusionPoles], phi_, base_;
};
AMBRIG_LAW_LANES(Eddy)
AMBRIG_LAW_COMMIT(Eddy)

class EddyLaw final : public FluxLaw {
 public:
  EddyLaw(double cutoff, double rho, double gap) : fit_(FitDiffusion(cutoff, rho)), gap_(gap) {}

  bool linear() const override { return true; }

  void SetStep(double h) override {
    if (h == h_) return;
    h_ = h;
    state_.slope = gap_ * fit_.tail / h;
    state_.ab = 0;
    for (int k = 0; k < kDiffusionPoles; ++k) {
      const double x = fit_.pole[k] * h;
      state_.a[k] = std::exp(-x);
      state_.b[k] = gap_ * fit_.residue[k] * -std::expm1(-x) / x;
      state_.ab += state_.a[k] * state_.b[k];
      state_.slope += state_.b[k];
    }
    Rebase();
  }

  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    EddyDrop(state_, phi, drop, slope);
  }
  void Steady(const Lane&, Lane*, Lane*) const override {}
  void Commit(const Lane& phi) override { EddyCommit(state_, phi); }
  int RunSamples(const LawLoop& loop, int k, int count) override {
    return EddyLoop(state_, loop, k, count);
  }

  void Settle(const Lane& phi) override {
    for (Lane& e : state_.e) e = Lane{};
    state_.phi = phi;
    Rebase();
  }

 private:
  void Rebase() {
    for (int j = 0; j < kLanes; ++j) {
      double kept = 0;
      for (int k = 0; k < kDiffusionPoles; ++k) kept += state_.a[k] * state_.e[k][j];
      state_.base[j] = kept - state_.slope * state_.phi[j];
    }
  }

  DiffusionFit fit_;
  double gap_;  // R_gap, rotor centred [1/H]
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
