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

#include "actuators/magnetics/law_loop.h"
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

namespace {

constexpr int kStops = 8;

/// One stop operator per row, all lanes; in units of flux [Wb].
struct StopsState {
  double radius[kStops] = {};   // r_k [Wb]
  double tangent[kStops] = {};  // MMF over flux of a stop that follows [1/H]
  Lane s[kStops];
  Lane phi;
};

template <class V>
class StopsKernel {
 public:
  static constexpr bool kLinear = false;
  [[gnu::always_inline]] explicit StopsKernel(const StopsState& stops)
      : stops_(stops), phi_(LoadAs<V>(stops.phi.v)) {
    for (int k = 0; k < kStops; ++k) s_[k] = LoadAs<V>(stops.s[k].v);
  }
  [[gnu::always_inline]] void Terms(const V& phi, V* drop, V* slope) const {
    const V change = phi - phi_;
    V sum[2] = {}, tangents[2] = {};  // of even and odd stops
    for (int k = 0; k < kStops; ++k) {
      const V free = s_[k] + change, held = Held(free, stops_.radius[k]);
      sum[k % 2] += held * stops_.tangent[k];
      tangents[k % 2] += Select(held == free, V(stops_.tangent[k]), V(0.0));
    }
    *drop = sum[0] + sum[1];
    *slope = tangents[0] + tangents[1];
  }
  [[gnu::always_inline]] void Commit(const V& phi) {
    const V change = phi - phi_;
    for (int k = 0; k < kStops; ++k) s_[k] = Held(s_[k] + change, stops_.radius[k]);
    phi_ = phi;
  }
  [[gnu::always_inline]] void Keep(StopsState* stops) const {
    for (int k = 0; k < kStops; ++k) Store(stops->s[k].v, s_[k]);
    Store(stops->phi.v, phi_);
  }

 private:
  /// s + Δφ, held within ±r.
  [[gnu::always_inline]] static V Held(const V& free, double r) {
    return Min(Max(free, V(-r)), V(r));
  }

  const StopsState& stops_;
  V s_[kStops], phi_;
};
AMBRIG_LAW_LANES(Stops)
AMBRIG_LAW_COMMIT(Stops)

class HysteresisLaw final : public FluxLaw {
 public:
  /// `mmf`: N coercive [A]; `width` in units of flux [Wb].
  HysteresisLaw(double mmf, double width) {
    for (int k = 0; k < kStops; ++k) {
      stops_.radius[k] = width * (k + 0.5) / kStops;
      stops_.tangent[k] = mmf / kStops / stops_.radius[k];
    }
  }
  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    StopsDrop(stops_, phi, drop, slope);
  }
  void Steady(const Lane& phi, Lane* drop, Lane* slope) const override {
    StopsDrop(AtRest(), phi, drop, slope);
  }
  void Commit(const Lane& phi) override { StopsCommit(stops_, phi); }
  int RunSamples(const LawLoop& loop, int k, int count) override {
    return StopsLoop(stops_, loop, k, count);
  }
  void Settle(const Lane& phi) override {
    stops_ = AtRest();
    StopsCommit(stops_, phi);
  }

 private:
  /// Iron that has never been magnetised.
  StopsState AtRest() const {
    StopsState stops = stops_;
    for (Lane& s : stops.s) s = Lane{};
    stops.phi = Lane{};
    return stops;
  }

  StopsState stops_;
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
