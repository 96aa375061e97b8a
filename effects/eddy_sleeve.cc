/// Eddy currents in a closed conductor round the flux: the guide tube of a plunger, a metal bobbin,
/// a yoke in one piece. It is one shorted turn of resistance R_s around each pole's flux:
///
///   E = φ'/R_s = R_gap φ'/ω_c,   so without iron φ = φ_static/(1 + j f/cutoff),  ω_c = R_gap R_s
///
/// First order: above the cutoff the flux falls by 20 dB a decade and the phase tends to -90
/// degrees, where diffusion into iron (effects/eddy_currents.cc) has 10 dB and -45 degrees. A
/// smaller gap lowers the cutoff with R_gap. The drop of a step of h is E = R_gap Δφ/(ω_c h), exact
/// for the linear flux of a step, and vanishes at rest. Source: docs/theory/published_values.md 7.
/// It acts on solenoids, opposed magnets and thrust bearings, whose yokes and guides are in one
/// piece. Radial stators are laminated: no conductor closes round their flux, and what thick sheets
/// do below their corner frequency is eddy-currents. Limits: the conductor is thinner than its skin
/// depth and encloses all flux but the leakage.
#include <cmath>
#include <memory>

#include "core/math/constants.h"
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

namespace {

class SleeveLaw final : public FluxLaw {
 public:
  explicit SleeveLaw(double per_rate) : per_rate_(per_rate) {}

  bool linear() const override { return true; }

  void SetStep(double h) override { slope_ = per_rate_ / h; }

  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    for (int j = 0; j < kLanes; ++j) {
      (*drop)[j] += slope_ * (phi[j] - phi_[j]);
      (*slope)[j] += slope_;
    }
  }

  void Steady(const Lane&, Lane*, Lane*) const override {}

  std::optional<LinearDrop> LinearAt(const Lane&) const override {
    LinearDrop out;
    out.damping = per_rate_;
    return out;
  }

  void Commit(const Lane& phi) override { phi_ = phi; }

  void Settle(const Lane& phi) override { phi_ = phi; }

 private:
  double per_rate_;   // 1/R_s [A s/Wb]
  double slope_ = 0;  // [A/Wb]
  Lane phi_;          // committed [Wb]
};

}  // namespace

EffectDescription EddySleeve() {
  EffectDescription d;
  d.id = "eddy-sleeve";
  d.title = "Eddy currents in a closed conductor round the flux";
  d.physics =
      "A guide tube, metal bobbin or solid yoke is a shorted turn: changing flux induces a current "
      "in "
      "it\nthat opposes the change; above the cutoff force and inductance fall by 20 dB a decade, "
      "phase\ntends to -90 degrees.";
  d.target = TargetKind::kBearing;
  d.acts_on = kOnThrust | kOnOpposed;
  d.parameters = {{"cutoff", "Hz", kInfinity, 1, kInfinity, 100, 1e4,
                   "frequency at which the conductor's MMF equals the gap's"}};
  d.off_when_null = {"cutoff"};
  d.shows_in =
      "current steps (a jump, then slow), inductance that falls with frequency; not at rest";
  d.confused_with =
      "eddy-currents (half order: falls less steeply), leakage, dead-time, loop-delay";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    if (!std::isfinite(e.Value("cutoff"))) return;
    BearingPlant& b = TargetBearing(e, plant);
    b.laws.push_back(
        std::make_unique<SleeveLaw>(GapReluctanceOf(b) / (2 * kPi * e.Value("cutoff"))));
  };
  return d;
}

}  // namespace ambrig
