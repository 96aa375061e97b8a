#pragma once
/// The catalogue of effects: every law that a rig file may name and that discovery tries.
#include <string>
#include <vector>

#include "effects/effect.h"

namespace ambrig {

/// Every effect, one line each in catalogue.cc.
const std::vector<EffectDescription>& Catalogue();
/// nullptr when there is none of that name.
const EffectDescription* FindEffect(const std::string& id);
/// @throws InputError that suggests the nearest name.
const EffectDescription& EffectNamed(const std::string& id);

}  // namespace ambrig
