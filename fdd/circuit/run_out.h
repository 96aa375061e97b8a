#pragma once
/// Run-out of the surfaces that the position sensors of a bearing see: errors of the reading that
/// turn with the shaft, of orders 1 and 2, the same at any speed.
///
///   x reads in addition  sum over n = 1, 2 of  c_n cos(n theta) + s_n sin(n theta);  y likewise.
///
/// theta: angle of the shaft as its mark tells. Both axes have errors of their own, because the
/// position at the bearing is put together of readings of several planes.
#include <array>
#include <cmath>

#include "fdd/measurement/period_slopes.h"

namespace ambrig {

inline constexpr std::size_t kRunOutTerms = 4;  // c1, s1, c2, s2

struct RunOut {
  std::array<double, kRunOutTerms> x = {}, y = {};  // [m]

  bool none() const {
    for (std::size_t k = 0; k < kRunOutTerms; ++k)
      if (x[k] != 0 || y[k] != 0) return false;
    return true;
  }
  /// Takes the errors off both positions of a period.
  void TakeOff(MeasuredPeriod* in) const {
    TakeOff(in->angle0, &in->x0, &in->y0);
    TakeOff(in->angle1, &in->x1, &in->y1);
  }

 private:
  void TakeOff(double angle, double* px, double* py) const {
    const double c = std::cos(angle), s = std::sin(angle);
    const double of[kRunOutTerms] = {c, s, c * c - s * s, 2 * c * s};
    for (std::size_t k = 0; k < kRunOutTerms; ++k) {
      *px -= x[k] * of[k];
      *py -= y[k] * of[k];
    }
  }
};

}  // namespace ambrig
