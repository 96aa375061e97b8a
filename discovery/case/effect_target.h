#pragma once
/// Whether an effect that a user names can act at the place that he names.
#include <string>

#include "effects/catalogue.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// @throws InputError "`refusal` the targets of this rig that the effect has", unless `wanted` is
/// one of them or is empty (any).
void RequireTarget(const EffectDescription& d, const RigParameters& rig, const std::string& wanted,
                   const std::string& refusal);

}  // namespace ambrig
