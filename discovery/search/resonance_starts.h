#pragma once
/// Starts of an effect of resonance from what was estimated of one: its sizes and shape such that
/// forces at the bearings move the sensors as estimated.
#include <vector>

#include "discovery/search/resonance_estimate.h"
#include "effects/effect.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// The same resonance with `factor` times the answer, which goes with the square of its two gains
/// or with one over its mass.
EffectInstance ScaledResonance(const EffectInstance& e, double factor);

/// Gains between the forces of two bearings and their sensors that `effect` adds to the rig's shaft
/// at rest, c of resonance_estimate.h [1/kg]. @throws InputError where the plant refuses it
Eigen::Matrix2d ResonanceGains(const RigParameters& rig, const EffectInstance& effect);

/// `null`: the effect at its null, at its place. For each estimate that it can resemble the
/// instances of nearest gains, best first: up to three that differ in what shapes them.
std::vector<EffectInstance> ResonanceStarts(const RigParameters& rig, const EffectInstance& null,
                                            const std::vector<ResonanceEstimate>& estimates);

}  // namespace ambrig
