#pragma once
/// The true rig of a practice case, sampled: rig parameters within their sd, effects within their
/// usual size at a place of the rig.
#include <cstdint>
#include <string>

#include "effects/effect.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Another machine of the type: every toleranced parameter moved by a normal draw, at most 2.5 sd,
/// and another `unit`, whose coils differ as the rig file says.
RigParameters DrawRig(const RigParameters& rig, std::uint64_t seed);

/// `wanted`, or with "" one of the targets of this rig. @throws InputError that lists them
std::string DrawTarget(const EffectDescription& d, const RigParameters& rig,
                       const std::string& wanted, std::uint64_t seed, std::uint32_t slot);

/// The effect with parameters within their usual range; optional extras stay at their null.
/// `slot`: which effect of the case.
EffectInstance DrawEffect(const EffectDescription& d, const std::string& target, std::uint64_t seed,
                          std::uint32_t slot);

/// The effect with its switches `k` times as far from their nulls, at most twice what is usual.
EffectInstance ScaledEffect(const EffectDescription& d, const EffectInstance& e, double k);

}  // namespace ambrig
