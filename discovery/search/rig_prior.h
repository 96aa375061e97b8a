#pragma once
/// The prior of the rig parameters in a fit: their nominal values and tolerances.
#include <algorithm>
#include <cmath>

#include "discovery/model/case_model.h"

namespace ambrig {

inline constexpr double kBelieved = 3;  // sd of a rig parameter within its tolerance
inline constexpr double kBeyond = 5;    // each further sd counts as so many

/// The prior's residual of a rig parameter that stands `sds` from its mean, and its slope. Gaussian
/// within three sd; a part further off hardly has the nominal value, and an effect that is
/// missing must not be paid with it.
inline double PriorResidual(double sds) {
  return sds + std::copysign((kBeyond - 1) * std::max(0.0, std::abs(sds) - kBelieved), sds);
}
inline double PriorSlope(double sds) { return std::abs(sds) > kBelieved ? kBeyond : 1; }
/// Σ of their squares over the rig parameters of `h`.
inline double PriorPenalty(const Hypothesis& h) {
  double sum = 0;
  for (std::size_t k = 0; k < h.free.size(); ++k)
    if (h.free[k].sd > 0) sum += std::pow(PriorResidual(h.Coordinate(k)), 2);
  return sum;
}

}  // namespace ambrig
