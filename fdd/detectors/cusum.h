#pragma once
/// Two-sided CUSUM of Page (1954) for a shift of a mean of known sign-free size:
///
///   g+ <- max(0, g+ + r - drift),   g- <- max(0, g- - r - drift),   statistic max(g+, g-)
///
/// r has unit variance; drift is half of the shift that is to be found fastest. Average run length
/// of one side for a shift d of the mean, Siegmund (1985):
///   ARL = (exp(-2 D b) + 2 D b - 1)/(2 D²),  D = d - drift,  b = h + 1.166     (D = 0: b²)
/// and 1/ARL = 1/ARL+ + 1/ARL- for both.
#include "fdd/detectors/linkage_residual.h"

namespace ambrig {

struct Cusum {
  double drift = 0.5;
  double up = 0, down = 0;

  double Add(double r);
  double statistic() const { return up > down ? up : down; }
};

/// Siegmund's approximation of the average run length of one side, threshold h. [samples]
double CusumRunLength(double shift, double drift, double h);

/// On the residuals of both phases of every coil. Drift 2.5: half of the shift of about five
/// expected sizes that a short of 5 % of the turns makes in the reference rig; tolerances alone
/// shift a residual by about one.
class CusumDetector : public CoilDetector {
 public:
  static constexpr double kDrift = 2.5;
  explicit CusumDetector(const CoilDetectorSetup& setup) : residual_(setup) {}
  Lane Period(const MeasuredPeriod& in) override;

 private:
  LinkageResidual residual_;
  Cusum chart_[2][kLanes] = {};
};

}  // namespace ambrig
