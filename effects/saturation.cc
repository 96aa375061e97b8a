/// Saturation: MMF drop of the iron in series with a pole's gap, H(B) * path, with H growing
/// steeply once the pole's flux density passes the knee (effects/steel_curve.h).
///
/// B counts over the gap's area. Iron of a smaller section a A holds B/a: its knee appears at a
/// times the steel's (1.4 to 1.6 T), so a slender yoke has a knee of 0.3 T here. `path` is the
/// iron's length. No memory; U and flux by Newton. Source: published_values.md 7 (saturation),
/// data/measured/bh_steel_msl.
#include <cmath>
#include <memory>

#include "actuators/magnetics/law_loop.h"
#include "actuators/magnetics/memoryless_law.h"
#include "effects/coil_targets.h"
#include "effects/effect.h"
#include "effects/steel_curve.h"

namespace ambrig {

namespace {

struct SaturationState {
  double x_per_flux;  // 1/(knee A) [1/Wb]
  double path;        // [m]
};

template <class V>
struct SaturationKernel : MemorylessKernel<V, SaturationState> {
  using MemorylessKernel<V, SaturationState>::MemorylessKernel;
  [[gnu::always_inline]] void Terms(const V& phi, V* drop, V* slope) const {
    const auto& [x_per_flux, path] = this->law;
    V H, tangent;
    SteelCurve(V(phi * x_per_flux), &H, &tangent);
    *drop = H * path;
    *slope = tangent * (path * x_per_flux);
  }
};
AMBRIG_LAW_LANES(Saturation)

class SaturationLaw final : public MemorylessLaw {
 public:
  SaturationLaw(double x_per_flux, double path) : steel_{x_per_flux, path} {}
  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    SaturationDrop(steel_, phi, drop, slope);
  }
  int RunSamples(const LawLoop& loop, int k, int count) override {
    return SaturationLoop(steel_, loop, k, count);
  }

 private:
  SaturationState steel_;
};

}  // namespace

EffectDescription Saturation() {
  EffectDescription d;
  d.id = "saturation";
  d.title = "Saturation of the iron";
  d.physics =
      "Past the knee of its magnetisation curve the iron needs steeply more MMF: force per current "
      "falls\n"
      "with the flux, inductance falls, and current slopes rise at high current.";
  d.target = TargetKind::kBearing;
  d.acts_on = kOnIron;
  d.parameters = {{"knee", "T", kInfinity, 0.1, kInfinity, 0.3, 1.6,
                   "flux density in the gap at which the iron needs 1000 A/m"},
                  {"path", "m", 0.1, 0, 2, 0.03, 0.2, "length of the saturating iron per gap"}};
  d.vanishing_order = 6;
  d.off_when_null = {"knee"};
  d.shows_in =
      "clamped ramps to high current: force and slope; harmonics of the force under large "
      "excitation";
  d.confused_with =
      "iron-reluctance (acts at every flux), current-sensor-gain, voltage limit (needs speed)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    if (!std::isfinite(e.Value("knee"))) return;
    BearingPlant& b = TargetBearing(e, plant);
    b.laws.push_back(
        std::make_unique<SaturationLaw>(DensityPerFlux(b) / e.Value("knee"), e.Value("path")));
  };
  return d;
}

}  // namespace ambrig
