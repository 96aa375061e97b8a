#pragma once
/// The paper's mean slopes against limits that are recomputed in every period from all that the
/// controller knows: measured bus, learned resistance, sensed gap and its motion, and the switch
/// states of the neighbours (published_values.md 1.2: they move a coupled coil's slope by more than
/// its own faults).
///
///   i(0) measured;  λ(k+1) = λ(k) + ∫v dt - R i h,  i = L(x, y)^-1 λ
///     currents of a healthy bearing
///   statistic  |k̄ - k̄ of the healthy currents| over the same kept slopes, in units of 700 A/s
///
/// The current at the start of the period is measured, so that what neighbours did before does not
/// count.
#include "fdd/circuit/inductance_matrix.h"
#include "fdd/detectors/resistance_estimate.h"
#include "fdd/detectors/slope.h"

namespace ambrig {

class SlopePrediction : public CoilDetector {
 public:
  explicit SlopePrediction(const CoilDetectorSetup& setup);
  Lane Period(const MeasuredPeriod& in) override;

 private:
  /// Currents of a healthy bearing at every sample. [A]
  void Predict(const MeasuredPeriod& in, Lane* current) const;
  double EvaluateStatistic(int j, const MeasuredPeriod& in, const Lane* current);

  LinkageModel model_;
  DetectorSettings s_;
  ResistanceEstimate resistance_;
  std::vector<double> measured_, predicted_;  // slopes [A/s]
};

}  // namespace ambrig
