#pragma once
#include "effects/effect.h"

namespace ambrig {

/// Reads parameters and formulas of a `formula` effect. @throws InputError naming the wrong formula.
void ReadFormula(const TomlTable& table, EffectInstance& effect);

}  // namespace ambrig
