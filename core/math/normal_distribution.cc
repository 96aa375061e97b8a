#include "core/math/normal_distribution.h"

#include <cmath>

#include "core/base/errors.h"
#include "core/math/constants.h"

namespace ambrig {

double NormalProbability(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

double NormalQuantile(double p) {
  Require(p > 0 && p < 1, "a probability");
  if (p > 0.5) return -NormalQuantile(1 - p);
  // Abramowitz and Stegun 26.2.23 (4.5e-4), then Newton's steps on ln Phi, which is concave.
  const double t = std::sqrt(-2 * std::log(p));
  double z = (2.515517 + t * (0.802853 + t * 0.010328)) /
                 (1 + t * (1.432788 + t * (0.189269 + t * 0.001308))) -
             t;
  for (int k = 0; k < 4; ++k) {
    const double phi = NormalProbability(z);
    z -= std::log(phi / p) * phi * std::sqrt(2 * kPi) * std::exp(0.5 * z * z);
  }
  return z;
}

}  // namespace ambrig
