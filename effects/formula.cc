#include "effects/formula.h"

namespace ambrig {

void ReadFormula(const TomlTable& table, EffectInstance&) { table.Fail("", "formula"); }

}  // namespace ambrig
