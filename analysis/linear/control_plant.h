#pragma once
/// The linear plant that a controller of a rig is designed for and judged by, sampled at the
/// controller's period: from the force command of one tick to the readings of the next
/// (loop_plant.h), with states in units of their typical sizes.
///
/// A synthesis takes the nominal rig without effects and one current per axis
/// (CurrentModel::kAxisPatterns); a figure of the loop takes what the analyses take, the true rig
/// and every coil (CurrentModel::kCoils).
#include "analysis/linear/shaft_weights.h"
#include "control/linear/sampled_plant.h"

namespace ambrig {

/// Of these axes: whole bearings, in ascending order; other axes get no force and their coordinates
/// must not need any (rigid rotor in z).
SampledPlant MakeControlPlant(const OperatingPoint& point, const std::vector<std::size_t>& axes,
                              double speed, CurrentModel currents,
                              const ShaftWeights& weights = {});

/// What a synthesis takes. `controllers`: the rig as the controller knows it, whose force constants
/// turn forces into set-points; default: `rig`. `maps`: of bearings whose coils have failed
/// (operating_point.h); empty: healthy ones.
SampledPlant MakeControlPlant(const RigParameters& rig, const std::vector<std::size_t>& axes,
                              double speed, const RigParameters* controllers = nullptr,
                              const ShaftWeights& weights = {},
                              const std::vector<CurrentMap>& maps = {});

}  // namespace ambrig
