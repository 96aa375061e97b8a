#pragma once
/// Which bearings and coils an effect's target means: "A", "A.coil3", or "rig" for all of them.
#include <string>

#include "core/base/errors.h"
#include "core/math/constants.h"
#include "effects/effect.h"
#include "effects/plant.h"

namespace ambrig {

/// The bearing that a target names, be it itself or one of its coils.
inline BearingPlant& TargetBearing(const EffectInstance& effect, Plant& plant) {
  BearingPlant* bearing = plant.Find(effect.target.substr(0, effect.target.find('.')));
  Require(bearing != nullptr, "the reader has checked the target");
  return *bearing;
}

/// Calls f(bearing, lane) for every coil that the target names.
template <class F>
void ForEachTargetCoil(const EffectInstance& effect, Plant& plant, F f) {
  const std::size_t coil = effect.target.find(".coil");
  if (coil != std::string::npos) {
    f(TargetBearing(effect, plant), std::stoi(effect.target.substr(coil + 5)) - 1);
    return;
  }
  for (BearingPlant& b : plant.bearings)
    if (effect.target == "rig" || effect.target == b.name)
      for (int j = 0; j < b.lanes.coils; ++j) f(b, j);
}

/// Flux density of a pole over its flux [T/Wb]. An opposed magnet's turns are unknown: there the
/// flux is the linkage and the result is the flux density per turn.
inline double DensityPerFlux(const BearingPlant& b) {
  return kMu0 * b.lanes.reluctance.per_metre * (b.lanes.coupling == Coupling::kSides ? 0.5 : 1.0);
}

/// Reluctance of a pole's gap, rotor centred [1/H].
inline double GapReluctanceOf(const BearingPlant& b) {
  return b.lanes.reluctance.per_metre * b.lanes.reluctance.gap0 + b.lanes.reluctance.offset;
}

}  // namespace ambrig
