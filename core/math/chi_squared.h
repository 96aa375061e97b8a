#pragma once
/// Quantiles of chi-squared numbers.
#include <cmath>

namespace ambrig {

/// What a chi-squared number of this freedom, over the freedom, stays below as often as a normal
/// number stays below `z`.
/// Source: E. B. Wilson, M. M. Hilferty, Proc. Natl. Acad. Sci. 17 (1931).
inline double QuantileOfMeanSquare(double freedom, double z) {
  const double part = 2 / (9 * freedom);
  return std::pow(1 - part + z * std::sqrt(part), 3);
}

}  // namespace ambrig
