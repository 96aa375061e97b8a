/// The iron of a pole by a table of its magnetisation curve: MMF in series with each gap, any
/// monotone shape. What `ambrig refine` writes where iron-reluctance or saturation was named.
///
///   dM/dφ = R' path(|B|),   path(b) linear between path0 .. path12 at b = reach k/12, then
///   constant
///
/// R' is the gap's reluctance per metre, so that a path of the same size everywhere is the effect
/// iron-reluctance, and path = mu0 dH/dB times the iron's length. M is an odd function of the flux
/// with a continuous slope, monotone because no path is negative. No memory. B counts over the
/// gap's area; at an opposed magnet, whose turns are unknown, per turn.
#include <cmath>
#include <memory>

#include "actuators/magnetics/memoryless_law.h"
#include "effects/coil_targets.h"
#include "effects/effect.h"
#include "effects/law_tables.h"

namespace ambrig {

namespace {

class TableLaw final : public MemorylessLaw {
 public:
  /// `path`: kBhNodes values [m]; `spacing` of the nodes [Wb]; `per_metre` [1/(H m)].
  TableLaw(const double* path, double spacing, double per_metre) : spacing_(spacing) {
    for (int k = 0; k < kBhNodes; ++k) slope_[k] = per_metre * path[k];
    for (int k = 1; k < kBhNodes; ++k)
      drop_[k] = drop_[k - 1] + 0.5 * spacing * (slope_[k - 1] + slope_[k]);
  }

  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    for (int j = 0; j < kLanes; ++j) {
      const double x = std::abs(phi[j]) / spacing_;
      const int k = x < kBhNodes - 1 ? static_cast<int>(x) : kBhNodes - 1;
      const double part = (x - k) * spacing_;
      const double bend = k < kBhNodes - 1 ? (slope_[k + 1] - slope_[k]) / spacing_ : 0;
      (*drop)[j] += std::copysign(drop_[k] + part * (slope_[k] + 0.5 * bend * part), phi[j]);
      (*slope)[j] += slope_[k] + bend * part;
    }
  }

 private:
  double spacing_;                                     // [Wb]
  double slope_[kBhNodes] = {}, drop_[kBhNodes] = {};  // at the nodes [1/H], [A]
};

}  // namespace

EffectDescription BhCurve() {
  EffectDescription d;
  d.id = "bh-curve";
  d.title = "Magnetisation curve of the iron as a table";
  d.physics =
      "The flux needs MMF for the iron by a curve of any monotone shape: the gap seems longer by "
      "path(B),\na table over the flux density of the pole. Written by `ambrig refine`.";
  d.target = TargetKind::kBearing;
  d.acts_on = kOnIron;
  d.users_own = true;
  d.parameters = {{"reach", "T", 1, 1e-3, 10, 0.5, 1.2, "flux density of the last node"}};
  for (int k = 0; k < kBhNodes; ++k) {
    d.parameters.push_back(
        {"path" + std::to_string(k), "m", 0, 0, 10, 2e-5, 5e-5,
         "incremental iron path, l dH/dB mu0, at " + std::to_string(k) + "/12 of reach"});
    d.off_when_null.push_back(d.parameters.back().name);
  }
  d.shows_in = "clamped ramps to high current; force and inductance at every flux";
  d.confused_with = "nothing that refine proposes: the effect is named before its curve is fitted";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    if (e.IsNull()) return;
    BearingPlant& b = TargetBearing(e, plant);
    b.laws.push_back(std::make_unique<TableLaw>(
        e.values.data() + 1, e.Value("reach") / (kBhNodes - 1) / DensityPerFlux(b),
        b.lanes.reluctance.per_metre));
  };
  return d;
}

}  // namespace ambrig
