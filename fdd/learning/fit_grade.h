#pragma once
/// How well a commissioned model expresses a plant: what it leaves of the rows' residuals that a detector would see.
#include <vector>

#include "fdd/learning/commissioning_rows.h"

namespace ambrig {

inline constexpr double kHuber = 2;  // [expected sizes] from which on a residual counts linearly

/// Cost of a residual over its expected size (Huber 1964).
inline double HuberCost(double z) {
  const double a = z < 0 ? -z : z;
  return a < kHuber ? z * z : 2 * kHuber * a - kHuber * kHuber;
}

/// Mean cost of a degree of freedom of `z`, the rows' residuals over their expected size, 1 where nothing but noise is
/// left. Of coils in the same periods and phase the fit of [1, cos, sin] to the relative errors is taken off first, as
/// the detector takes it off c: neither a displaced shaft (run-out, a slow sensor) nor a cause common to the bearing
/// counts, only what could be taken for a coil's own fault. Fewer than five coils: all counts.
double FitGrade(const LinkageModel& nominal, const CommissioningRows& rows,
                const CoilEquations& coils, const std::vector<double>& z);

}  // namespace ambrig
