#pragma once
/// How much likelier the slopes of a period are without a current (c = -1) than of a healthy coil
/// (c = 0), slope_excess.h. c has the variance 1/bottom, so that the logarithm of the ratio is
/// (c^2 - (c + 1)^2) bottom/2 = -(top + bottom/2).
#include "fdd/circuit/slope_excess.h"

namespace ambrig {

/// Sum over the periods from which on it is sure: one in 10^9 tries.
inline constexpr double kSurelyNoCurrent = 20;

inline double LikelihoodOfNoCurrent(const SlopeExcess& e, int coil) {
  const double top = e.top[0][coil] + e.top[1][coil],
               bottom = e.bottom[0][coil] + e.bottom[1][coil];
  return -(top + 0.5 * bottom);
}

}  // namespace ambrig
