/// Iron in series with each gap: R = (g + path)/(mu0 A), path = l_fe/mu_r.
///
/// Force still is phi²/(2 mu0 A) per pole, so current and position stiffness both fall while
/// ki/ks = (g0 + path)/i0 grows (published_values.md 7).
///
/// The permeability of steel rises from its initial value to a maximum at 0.6 to 1 T (Bozorth,
/// Ferromagnetism, 1951, ch. 11): the MMF grows steeply at first and less than in proportion
/// above. `threshold` is that part, threshold x/(1 + x) with x = B/0.2 T. Limit: no knee; see
/// saturation.
#include <memory>

#include "actuators/magnetics/law_loop.h"
#include "actuators/magnetics/memoryless_law.h"
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

namespace {

constexpr double kThresholdDensity = 0.2;  // [T] at which half of the threshold is reached

struct ThresholdState {
  double x_per_flux;  // 1/(0.2 T A) [1/Wb]
  double mmf;         // [A]
};

template <class V>
struct ThresholdKernel : MemorylessKernel<V, ThresholdState> {
  using MemorylessKernel<V, ThresholdState>::MemorylessKernel;
  [[gnu::always_inline]] void Terms(const V& phi, V* drop, V* slope) const {
    const auto& [x_per_flux, mmf] = this->law;
    const V x = phi * x_per_flux, inverse = 1.0 / (V(1.0) + Abs(x));
    *drop = x * mmf * inverse;
    *slope = inverse * inverse * (mmf * x_per_flux);
  }
};
AMBRIG_LAW_LANES(Threshold)

class MagnetisingThreshold final : public MemorylessLaw {
 public:
  MagnetisingThreshold(double x_per_flux, double threshold) : law_{x_per_flux, threshold} {}
  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    ThresholdDrop(law_, phi, drop, slope);
  }
  int RunSamples(const LawLoop& loop, int k, int count) override {
    return ThresholdLoop(law_, loop, k, count);
  }

 private:
  ThresholdState law_;
};

}  // namespace

EffectDescription IronReluctance() {
  EffectDescription d;
  d.id = "iron-reluctance";
  d.title = "Reluctance of the iron path";
  d.physics =
      "The flux needs MMF for the iron too, not only for the gap: every gap acts as if it were "
      "longer\n"
      "by l_fe/mu_r, while the pull per flux stays the same.";
  d.target = TargetKind::kBearing;
  d.acts_on = kOnIron;
  d.parameters = {{"path", "m", 0, 0, 1e-3, 5e-6, 5e-5, "iron length over mu_r, per gap"},
                  {"threshold", "A", 0, 0, 200, 1, 10,
                   "MMF per gap that the iron needs at low flux, beyond path"}};
  d.off_when_null = {"path", "threshold"};
  d.shows_in =
      "clamped current steps and ramps: less force and less inductance at every rotor position";
  d.confused_with = "a larger gap (whose force falls faster with position), fewer turns, fringing";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    BearingPlant& b = TargetBearing(e, plant);
    b.lanes.reluctance.iron_path = e.Value("path");
    if (e.Value("threshold") > 0)
      b.laws.push_back(std::make_unique<MagnetisingThreshold>(DensityPerFlux(b) / kThresholdDensity,
                                                              e.Value("threshold")));
  };
  return d;
}

}  // namespace ambrig
