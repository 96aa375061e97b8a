#include "fdd/measurement/motion_uncertainty.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

/// 1/g of a coil's gap, by the reluctance that changes with it. [1/m]
double PerGap(const LinkageModel& m, const PeriodSlopes& s, int j) {
  return std::max(s.permeance.start[j], s.permeance.end[j]) * m.reluctance.per_metre;
}

double LargestLinkage(const PeriodSlopes& s, int j) {
  return std::max(std::abs(s.first[j]), std::abs(s.last[j]));
}

/// Change of every coil's linkage with the position. [Wb/m]
Lane Sensitivity(const LinkageModel& m, const PeriodSlopes& s) {
  Lane out;
  double potential = 0;
  for (int j = 0; j < m.coils; ++j) {
    out[j] = LargestLinkage(s, j) * PerGap(m, s, j);
    if (m.n[j] != 0) potential += out[j] / std::abs(m.n[j]);
  }
  if (m.coupling != Coupling::kFloatingRotor || !(s.permeance.total > 0)) return out;
  for (int j = 0; j < m.coils; ++j)
    out[j] += std::abs(m.n[j]) * s.permeance.middle[j] * potential / s.permeance.total;
  return out;
}

}  // namespace

void ResidualUncertainty(const LinkageModel& m, const PeriodSlopes& slopes,
                         const MotionUncertainty& uncertainty, Lane out[2]) {
  const Lane moved = Sensitivity(m, slopes);
  for (int q = 0; q < 2; ++q)
    for (int j = 0; j < m.coils; ++j)
      out[q][j] = moved[j] * uncertainty.velocity + std::abs(slopes.phase[q].linkage[j]) *
                                                        PerGap(m, slopes, j) * uncertainty.position;
}

Lane LinkageUncertainty(const LinkageModel& m, const PeriodSlopes& slopes, double position) {
  Lane out = Sensitivity(m, slopes);
  for (double& v : out.v) v *= position;
  return out;
}

}  // namespace ambrig
