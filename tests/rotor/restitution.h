#pragma once
/// Coefficient of restitution of the contact law N = k pⁿ (1 + h p') on a free mass that arrives
/// with speed v. Independent of k, n and the mass: with a = h v, e is the root in (0, 1] of
///   a - ln(1 + a) = -a e - ln(1 - a e),
/// from dv/dp = -(k pⁿ/m)(1 + h v)/v integrated over approach and rebound.
/// Source: docs/theory/published_values.md 5 (contact laws and their actual restitution).
#include <algorithm>
#include <cmath>

namespace ambrig {

/// `damping` h [s/m], `speed` v >= 0 [m/s]. 1 without damping or speed.
inline double Restitution(double damping, double speed) {
  const double a = damping * speed;
  if (a <= 0) return 1;
  if (a < 1e-4) return 1 - 2 * a / 3;  // of order a² = 1e-8; the logarithms cancel down here
  const double in = a - std::log1p(a);
  double low = 0, high = std::min(1.0, 1 / a);
  for (int k = 0; k < 200 && high - low > 1e-15; ++k) {
    const double e = (low + high) / 2;
    (-a * e - std::log1p(-a * e) < in ? low : high) = e;
  }
  return (low + high) / 2;
}

}  // namespace ambrig
