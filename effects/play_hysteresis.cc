/// Hysteresis by eight operators of free size: what `ambrig refine` writes where hysteresis was
/// named.
///
///   M = N Σ_k c_k s_k/r_k,   s_k <- clamp(s_k + ΔB, ±r_k),   r_k = width k/8,   c_k >= 0
///
/// s_k = B - Play_rk(B) is the stop operator of radius r_k: a sum of stops with sizes of their own
/// is a sum of plays of the flux density, written for the MMF (Prandtl-Ishlinskii). Return-point
/// memory, closed minor loops, no dependence on rate; with equal sizes it is effects/hysteresis.cc.
/// A run starts on the virgin curve.
#include <algorithm>
#include <cmath>
#include <memory>

#include "effects/coil_targets.h"
#include "effects/effect.h"
#include "effects/law_tables.h"

namespace ambrig {

namespace {

class PlayLaw final : public FluxLaw {
 public:
  /// `mmf`: saturated size of each operator [A]; `width`: largest radius as flux [Wb].
  PlayLaw(const double* mmf, double turns, double width) {
    for (int k = 0; k < kPlayOperators; ++k) {
      radius_[k] = width * (k + 1) / kPlayOperators;
      tangent_[k] = turns * mmf[k] / radius_[k];
    }
  }
  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    Add(stop_, phi_, phi, drop, slope);
  }
  void Steady(const Lane& phi, Lane* drop, Lane* slope) const override {
    const Lane none[kPlayOperators] = {};
    Add(none, Lane{}, phi, drop, slope);
  }
  void Commit(const Lane& phi) override {
    for (int k = 0; k < kPlayOperators; ++k)
      for (int j = 0; j < kLanes; ++j)
        stop_[k][j] = std::clamp(stop_[k][j] + phi[j] - phi_[j], -radius_[k], radius_[k]);
    phi_ = phi;
  }
  void Settle(const Lane& phi) override {
    for (Lane& s : stop_) s = Lane{};
    phi_ = Lane{};
    Commit(phi);
  }

 private:
  void Add(const Lane* stop, const Lane& from, const Lane& phi, Lane* drop, Lane* slope) const {
    for (int k = 0; k < kPlayOperators; ++k)
      for (int j = 0; j < kLanes; ++j) {
        const double free = stop[k][j] + phi[j] - from[j];
        const double held = std::clamp(free, -radius_[k], radius_[k]);
        (*drop)[j] += tangent_[k] * held;
        (*slope)[j] += held == free ? tangent_[k] : 0.0;
      }
  }

  double radius_[kPlayOperators] = {}, tangent_[kPlayOperators] = {};  // [Wb], [1/H]
  Lane stop_[kPlayOperators], phi_;                                    // [Wb]
};

}  // namespace

EffectDescription PlayHysteresis() {
  EffectDescription d;
  d.id = "play-hysteresis";
  d.title = "Hysteresis as a sum of operators";
  d.physics =
      "The iron's MMF follows its turning points by eight operators of evenly spread widths and "
      "free sizes:\na loop of any convex shape. Written by `ambrig refine`.";
  d.target = TargetKind::kBearing;
  d.acts_on = kOnIron;
  d.users_own = true;
  d.parameters = {
      {"width", "T", 0.2, 1e-3, 10, 0.3, 0.6, "flux density of the widest operator's crossing"}};
  for (int k = 1; k <= kPlayOperators; ++k) {
    d.parameters.push_back({"c" + std::to_string(k), "A", 0, 0, 10, 0.005, 0.012,
                            "size of the operator of radius " + std::to_string(k) +
                                "/8 of width, as current of one coil"});
    d.off_when_null.push_back(d.parameters.back().name);
  }
  d.shows_in = "clamped ramps up and down: force on the way down exceeds that on the way up";
  d.confused_with = "nothing that refine proposes: the effect is named before its loop is fitted";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    if (e.IsNull()) return;
    BearingPlant& b = TargetBearing(e, plant);
    b.laws.push_back(std::make_unique<PlayLaw>(e.values.data() + 1, std::abs(b.lanes.n[0]),
                                               e.Value("width") / DensityPerFlux(b)));
  };
  return d;
}

}  // namespace ambrig
