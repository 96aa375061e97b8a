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
#include <memory>

#include "actuators/magnetics/lane_vector.h"
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

namespace {

using V = LaneVector;

constexpr int kStops = 8;

/// One stop operator per row, all lanes; in units of flux [Wb].
struct Stops {
  Lane s[kStops];
  Lane phi;
};

/// s + Δφ, held within ±r.
[[gnu::always_inline]] static inline V Held(const V& free, double r) {
  return Min(Max(free, -r), r);
}

AMBRIG_WIDE void AddHysteresisDrop(const Stops& stops, const double* radius, double weight,
                                   const double* phi, double* drop, double* slope) {
  const V change = Load(phi) - Load(stops.phi.v);
  V sum = Load(drop), tangents = Load(slope);
  for (int k = 0; k < kStops; ++k) {
    const double tangent = weight / radius[k];
    const V free = Load(stops.s[k].v) + change, held = Held(free, radius[k]);
    sum += tangent * held;
    tangents += Select(held == free, tangent, 0.0);
  }
  Store(drop, sum);
  Store(slope, tangents);
}

AMBRIG_WIDE void AdvanceStops(const double* radius, const double* phi, Stops& stops) {
  const V now = Load(phi), change = now - Load(stops.phi.v);
  for (int k = 0; k < kStops; ++k)
    Store(stops.s[k].v, Held(Load(stops.s[k].v) + change, radius[k]));
  Store(stops.phi.v, now);
}

class HysteresisLaw final : public FluxLaw {
 public:
  /// `mmf`: N coercive [A]; `width` in units of flux [Wb].
  HysteresisLaw(double mmf, double width) : weight_(mmf / kStops) {
    for (int k = 0; k < kStops; ++k) radius_[k] = width * (k + 0.5) / kStops;
  }
  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    AddHysteresisDrop(stops_, radius_, weight_, phi.v, drop->v, slope->v);
  }
  void Steady(const Lane& phi, Lane* drop, Lane* slope) const override {
    AddHysteresisDrop(Stops{}, radius_, weight_, phi.v, drop->v, slope->v);
  }
  void Commit(const Lane& phi) override { AdvanceStops(radius_, phi.v, stops_); }
  void Settle(const Lane& phi) override {
    stops_ = Stops{};
    AdvanceStops(radius_, phi.v, stops_);
  }

 private:
  double weight_;  // [A]
  double radius_[kStops];
  Stops stops_;
};

}  // namespace

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
    const double turns = std::abs(b.lanes.n[0]);
    b.laws.push_back(std::make_unique<HysteresisLaw>(turns * e.Value("coercive"),
                                                     e.Value("width") / DensityPerFlux(b)));
  };
  return d;
}

}  // namespace ambrig
