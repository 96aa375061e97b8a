#pragma once
/// Current measurement of one coil: gain, offset, noise, then a signed ADC of m bits over ±range.
/// Source: docs/theory/base_model.md section 3 (1), 6.
#include <cmath>

namespace ambrig {

struct CurrentSensor {
  double gain = 1;
  double offset = 0;  // [A]
  bool stuck = false;
  double stuck_at = 0;  // [A]
};

/// Signed quantiser: step 2 range / 2^bits, clipped to the range.
struct Quantiser {
  double step = 0;  // [A]
  double low = 0, high = 0;
  Quantiser() = default;
  Quantiser(double bits, double range)
      : step(2 * range / std::exp2(bits)), low(-range), high(range - step) {}
  double operator()(double value) const {
    const double q = std::nearbyint(value / step) * step;
    return q < low ? low : (q > high ? high : q);
  }
};

}  // namespace ambrig
