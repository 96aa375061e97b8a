/// Hysteresis: the iron's MMF depends on the turning points of its flux density
/// (Prandtl-Ishlinskii).
///
///   E = N coercive (1/n) Σ_k s_k / r_k,   s_k <- clamp(s_k + ΔB, ±r_k),   r_k = width (k - 1/2)/n,
///   n = 8
///
/// Stop operators: return-point memory, closed minor loops, no dependence on rate, |E| <= N
/// coercive. A loop between ±B of at least `width` costs 4 N coercive A (B - width/2) of energy:
/// the closed form of the test. `width` is the flux density after a turning point within which the
/// branch crosses over by half: the whole crossing takes 2 width. A run starts on the virgin curve.
/// Source: published_values.md 7 (hysteresis); Hc of the loops in data/measured/bh_steel_msl.
#include <cmath>

#include "effects/coil_targets.h"
#include "effects/effect.h"
#include "effects/stop_law.h"

namespace ambrig {

EffectDescription Hysteresis() {
  EffectDescription d;
  d.id = "hysteresis";
  d.title = "Hysteresis of the iron";
  d.physics =
      "The iron's MMF depends on the last reversal of its flux: rising and falling branches lie "
      "twice the\ncoercive current apart, minor loops close, and remanence stays at zero current.";
  d.target = TargetKind::kBearing;
  d.acts_on = kOnIron;
  d.parameters = {
      {"coercive", "A", 0, 0, 10, 0.005, 0.2, "half the width of the loop, as current of one coil"},
      {"width", "T", 0.2, 1e-3, 3, 0.03, 0.5, "flux density within which the branches cross over"}};
  d.off_when_null = {"coercive"};
  d.shows_in =
      "clamped ramps up and down: force on the way down exceeds that on the way up; any frequency";
  d.confused_with = "eddy-currents (lag grows with frequency), current-sensor-offset (no branches)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    BearingPlant& b = TargetBearing(e, plant);
    const double mmf = std::abs(b.lanes.n[0]) * e.Value("coercive"),
                 width = e.Value("width") / DensityPerFlux(b);
    std::array<double, kStops> radius, tangent;
    for (std::size_t k = 0; k < kStops; ++k) {
      radius[k] = width * (static_cast<double>(k) + 0.5) / kStops;
      tangent[k] = mmf / kStops / radius[k];
    }
    b.laws.push_back(MakeStopLaw(radius, tangent));
  };
  return d;
}

}  // namespace ambrig
