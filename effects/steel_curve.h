#pragma once
/// Magnetisation curve of electrical steel past its bend, one shape for all grades:
///
///   H(B) = 2000 A/m x^17 / (1 + x^10 + c x^16),  x = B/knee,  c = 2000 mu0/(1.5 T)
///
/// H(knee) = 1000 A/m, 2 to 4 doublings of H per 0.1 T around it, and the slope of air far beyond.
/// Below the bend iron needs next to nothing; what it needs there is the effect iron-reluctance.
/// Source: mean of rising and falling branch of M270-50A to M800-65A (data/measured/bh_steel_msl),
/// met within a factor 1.5 from 250 to 20 000 A/m with knees of 1.44 to 1.57 T (tests/effects).
#include "core/math/constants.h"

namespace ambrig {

/// H [A/m] and dH/dx [A/m] at x = B/knee, of one number or of all lanes.
template <class T>
[[gnu::always_inline]] static inline void SteelCurve(const T& x, T* H, T* slope) {
  constexpr double kScale = 2000, kAir = kScale * kMu0 / 1.5;
  const T y = x * x, y2 = y * y, y4 = y2 * y2, y8 = y4 * y4;
  const T below = 1 + y4 * y + kAir * y8;
  const T ratio = y8 / below;
  *H = kScale * x * ratio;
  *slope = kScale * ratio * (17 - (10 * y4 * y + 16 * kAir * y8) / below);
}

}  // namespace ambrig
