#include "analysis/api617.h"

#include <algorithm>

namespace ambrig {

SeparationMargin JudgeSeparation(double critical, double amplification, double lowest, double highest) {
  SeparationMargin m;
  const bool above = critical > highest, below = critical < lowest;
  if (above) m.actual = 100 * (critical / highest - 1);
  if (below) m.actual = 100 * (1 - critical / lowest);
  const double base = amplification > 0 ? 17 * (1 - 1 / std::max(amplification - 1.5, 1.0)) : 17;
  if (amplification <= 0 || amplification >= 2.5) m.required = above ? 10 + base : base;
  m.met = (amplification > 0 && amplification < 2.5) || ((above || below) && m.actual >= m.required);
  return m;
}

}  // namespace ambrig
