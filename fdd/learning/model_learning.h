#pragma once
/// What the residuals of healthy running tell of the nominal model's error, and how large they
/// usually are.
///
///   e = -(leakage error) di + (gap error) flux       di: slope of the current, flux: of n φ
///
/// Bayes: normal equations with forgetting over the maker's tolerances as a prior. Coils differ
/// within a bearing, so that some of the tolerances stays in uncertainty however much was learned.
#include "fdd/measurement/residual_chart.h"

namespace ambrig {

class ModelLearning {
 public:
  /// Tolerances: leakage [H], gap relative.
  ModelLearning(double leakage_sd, double gap_sd);

  const ModelError& known() const { return known_; }
  /// Learns from one period, which stands for `periods`; every coil's long-term |z| in `chart`
  /// follows too.
  void Learn(const LinkageModel& m, const PeriodSlopes& slopes, int periods, ResidualChart* chart);

 private:
  void Solve();

  double leakage_sd_, gap_sd_;
  double info_[3] = {0, 0, 0}, pull_[2] = {0, 0};  // normal matrix (00, 01, 11) and right side
  ModelError known_;
};

}  // namespace ambrig
