#pragma once
/// An effect as one meets it.
#include <string>

#include "effects/effect.h"

namespace ambrig {

/// The effect with the middle of what is usual, of the numbers that switch it on; the others at
/// their nulls.
EffectInstance AtUsualSize(const EffectDescription& d, const std::string& target);

}  // namespace ambrig
