#pragma once
/// How finely a model resolves a switching period.
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// How finely the current samples of a switching period are resolved. Differences between two
/// coarse predictions are sensitivities that err by a few percent, at less cost.
enum class ModelFidelity { kAsSampled, kCoarse };

inline constexpr double kCoarseSamples = 6;  // of the current, in a switching period
/// [s] before t = 0, half of what a levitated run has: what is left of the start is nearly the same
/// in two coarse runs, which are compared with each other only.
inline constexpr double kCoarseWarmUp = 0.125;

/// Whether a rig has fewer current samples than its file states: it is simulated coarsely.
inline bool IsCoarse(const RigParameters& rig, const RigParameters& as_filed) {
  return rig.amplifier.adc_samples_per_period < as_filed.amplifier.adc_samples_per_period;
}

}  // namespace ambrig
