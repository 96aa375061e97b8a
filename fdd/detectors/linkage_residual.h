#pragma once
/// Residuals of the coupled coils' voltage equations over their expected size, without learning and
/// without a control chart: what a GLRT or a CUSUM is put on.
///
///   z_q = e_q / s_q,  q = on, off;
///     s² = ADC noise + (gap_sd flux)² + (leakage_sd di/dt)² + voltage_sd²
///
/// (period_slopes.h, residual_chart.h). Tolerances count as if they were noise, though they stay
/// the same from period to period.
#include "fdd/detectors/coil_detector.h"

namespace ambrig {

class LinkageResidual {
 public:
  explicit LinkageResidual(const CoilDetectorSetup& setup);

  /// False: nothing can be concluded from this period (position unknown, a gap nearly closed).
  bool Compute(const MeasuredPeriod& in);
  double z(int phase, int coil) const { return chart_.z[phase][coil]; }
  bool valid(int phase, int coil) const { return chart_.valid[phase][coil] > 0; }

 private:
  LinkageModel model_;
  DetectorSettings s_;
  ModelError tolerance_;
  PeriodSlopes slopes_;
  ResidualChart chart_;
  Lane watched_;
  double centred_ = 0;  // largest permeance at the centre [H]
};

}  // namespace ambrig
