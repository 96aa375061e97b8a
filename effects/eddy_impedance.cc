/// Eddy currents as a sum of relaxations: what `ambrig refine` writes where eddy-currents was named.
///
///   M(s) = R_gap Σ r_k s/(s + p_k) φ(s) + R' path φ(s),   r_k >= 0,  p_k = 2 pi (16 Hz .. 500 kHz)
///
/// ten corner frequencies half a decade apart, so that any lamination, plate or solid core is met
/// within a few per cent; passive by construction, because every term is a resistance beside an
/// inductance. At rest only `path` is left (the iron's own reluctance). For a flux linear over a
/// step the relaxations are exact, as in effects/eddy_currents.cc.
#include <cmath>
#include <memory>

#include "core/math/constants.h"
#include "effects/coil_targets.h"
#include "effects/effect.h"
#include "effects/law_tables.h"

namespace ambrig {

namespace {

class RelaxationLaw final : public FluxLaw {
 public:
  /// `residue`: kRelaxations numbers of the gap's reluctance `gap` [1/H]; `rest` [1/H].
  RelaxationLaw(const double* residue, double gap, double rest) : rest_(rest) {
    for (int k = 0; k < kRelaxations; ++k) weight_[k] = residue[k] * gap;
  }

  bool linear() const override { return true; }

  void SetStep(double h) override {
    if (h == h_) return;
    h_ = h;
    slope_ = rest_;
    for (int k = 0; k < kRelaxations; ++k) {
      const double x = 2 * kPi * RelaxationFrequency(k) * h;
      decay_[k] = std::exp(-x);
      gain_[k] = weight_[k] * -std::expm1(-x) / x;
      slope_ += gain_[k];
    }
    Rebase();
  }

  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    for (int j = 0; j < kLanes; ++j) {
      (*drop)[j] += base_[j] + slope_ * phi[j];
      (*slope)[j] += slope_;
    }
  }

  void Steady(const Lane& phi, Lane* drop, Lane* slope) const override {
    for (int j = 0; j < kLanes; ++j) {
      (*drop)[j] += rest_ * phi[j];
      (*slope)[j] += rest_;
    }
  }

  void Commit(const Lane& phi) override {
    for (int k = 0; k < kRelaxations; ++k)
      for (int j = 0; j < kLanes; ++j)
        state_[k][j] = decay_[k] * state_[k][j] + gain_[k] * (phi[j] - phi_[j]);
    phi_ = phi;
    Rebase();
  }

  void Settle(const Lane& phi) override {
    for (Lane& e : state_) e = Lane{};
    phi_ = phi;
    Rebase();
  }

 private:
  /// Drop of the next step less slope_ φ.
  void Rebase() {
    for (int j = 0; j < kLanes; ++j) {
      double kept = (rest_ - slope_) * phi_[j];
      for (int k = 0; k < kRelaxations; ++k) kept += decay_[k] * state_[k][j];
      base_[j] = kept;
    }
  }

  double weight_[kRelaxations] = {};                           // [1/H]
  double decay_[kRelaxations] = {}, gain_[kRelaxations] = {};  // of a step
  double rest_, slope_ = 0, h_ = 0;                            // [1/H], [1/H], [s]
  Lane state_[kRelaxations], phi_, base_;                      // [A], [Wb], [A]
};

}  // namespace

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
    b.laws.push_back(std::make_unique<RelaxationLaw>(
        e.values.data() + 1, GapReluctanceOf(b), e.Value("path") * b.lanes.reluctance.per_metre));
  };
  return d;
}

}  // namespace ambrig
