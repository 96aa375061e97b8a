/// Hysteresis by eight operators of free size: what `ambrig refine` writes where hysteresis was
/// named.
///
///   M = N Σ_k c_k s_k/r_k,   s_k <- clamp(s_k + ΔB, ±r_k),   r_k = width (k/8)²,   c_k >= 0
///
/// s_k = B - Play_rk(B) is the stop operator of radius r_k: a sum of stops with sizes of their own
/// is a sum of plays of the flux density, written for the MMF (Prandtl-Ishlinskii). Return-point
/// memory, closed minor loops, no dependence on rate; effects/hysteresis.cc has evenly spread radii
/// of one size. A run starts on the virgin curve.
#include <cmath>

#include "effects/coil_targets.h"
#include "effects/effect.h"
#include "effects/law_tables.h"
#include "effects/stop_law.h"

namespace ambrig {

EffectDescription PlayHysteresis() {
  EffectDescription d;
  d.id = "play-hysteresis";
  d.title = "Hysteresis as a sum of operators";
  d.physics =
      "The iron's MMF follows its turning points by eight operators of fixed widths and "
      "free sizes:\na loop of any convex shape. Written by `ambrig refine`.";
  d.target = TargetKind::kBearing;
  d.acts_on = kOnIron;
  d.users_own = true;
  d.parameters = {
      {"width", "T", 0.2, 1e-3, 10, 0.3, 0.6, "flux density of the widest operator's crossing"}};
  for (int k = 1; k <= kPlayOperators; ++k) {
    d.parameters.push_back({"c" + std::to_string(k), "A", 0, 0, 10, 0.005, 0.012,
                            "size of the operator of radius " + std::to_string(k * k) +
                                "/64 of width, as current of one coil"});
    d.off_when_null.push_back(d.parameters.back().name);
  }
  d.shows_in = "clamped ramps up and down: force on the way down exceeds that on the way up";
  d.confused_with = "nothing that refine proposes: the effect is named before its loop is fitted";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    if (e.IsNull()) return;
    BearingPlant& b = TargetBearing(e, plant);
    static_assert(kPlayOperators == kStops);
    const double turns = std::abs(b.lanes.n[0]), width = e.Value("width") / DensityPerFlux(b);
    std::array<double, kStops> radius, tangent;
    for (std::size_t k = 0; k < kStops; ++k) {
      radius[k] = width * PlayRadius(static_cast<int>(k) + 1);
      tangent[k] = turns * e.values[k + 1] / radius[k];
    }
    b.laws.push_back(MakeStopLaw(radius, tangent));
  };
  return d;
}

}  // namespace ambrig
