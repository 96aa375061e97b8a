#include "fdd/detectors/cusum.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

double Cusum::Add(double r) {
  up = std::max(0.0, up + r - drift);
  down = std::max(0.0, down - r - drift);
  return statistic();
}

double CusumRunLength(double shift, double drift, double h) {
  const double D = shift - drift, b = h + 1.166;
  if (std::abs(D * b) < 1e-4) return b * b;
  return (std::expm1(-2 * D * b) + 2 * D * b) / (2 * D * D);
}

Lane CusumDetector::Period(const MeasuredPeriod& in) {
  const bool comparable = residual_.Compute(in);
  Lane out;
  for (int q = 0; q < 2; ++q)
    for (int j = 0; j < kLanes; ++j) {
      Cusum& c = chart_[q][j];
      c.drift = kDrift;
      if (comparable && residual_.valid(q, j)) c.Add(residual_.z(q, j));
      out[j] = std::max(out[j], c.statistic());
    }
  return out;
}

CoilDetectorKind CusumOfResiduals() {
  return {"cusum",   "-",  "two-sided sums on the coupled residuals",
          kRequired, 22.1, MakeDetector<CusumDetector>};
}

}  // namespace ambrig
