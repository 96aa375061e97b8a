#include "analysis/api617.h"

namespace ambrig {

SeparationMargin AssessSeparation(double critical, double amplification, double lowest,
                                  double highest) {
  SeparationMargin m;
  const bool above = critical > highest, below = critical < lowest;
  if (above) m.actual = 100 * (critical / highest - 1);
  if (below) m.actual = 100 * (1 - critical / lowest);
  const bool damped = amplification < 2.5;
  const double base = damped ? 0 : 17 * (1 - 1 / (amplification - 1.5));
  m.required = damped ? 0 : above ? 10 + base : base;
  m.met = damped || ((above || below) && m.actual >= m.required);
  return m;
}

}  // namespace ambrig
