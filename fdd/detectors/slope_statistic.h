#pragma once
/// The paper's slope detector (slope.h) on the coils of a bearing, as a statistic: the largest
/// distance of a mean slope from its theoretical range, in units of the paper's error budget of 700
/// A/s. The paper flags a fault above 1.
///
/// Fixed thresholds (the paper): bus, resistance and inductance are those of the nominal rig,
/// centred. Online thresholds (the paper's future work): recomputed in every period from
///   bus         measured, mean of the period
///   resistance  R + what the mean bridge voltage and the mean current of the last 0.1 s tell of it
///   gap         L_j of the sensed position, and the motion's voltage i n² dP/dt
/// Neighbours stay ignored: a coil is judged as one that switches together with all others
/// (slope_prediction.h takes them in).
///
/// A phase of fewer than four samples is not judged; a cycle looks at its last period only and
/// holds its statistic until the next one (1.75 ms in the paper's processor).
#include "fdd/detectors/coil_detector.h"
#include "fdd/detectors/resistance_estimate.h"
#include "fdd/detectors/slope.h"

namespace ambrig {

/// Inductance of coil j while all coils of its bearing are driven alike: n² P + L_l on a rotor that
/// floats between alternating poles (centred: exact), twice n² P for two windings on one core. [H]
double InPhaseInductance(const LinkageModel& m, int j, const Lane& P);

class SlopeStatistic : public CoilDetector {
 public:
  enum class Thresholds { kFixed, kOnline };
  SlopeStatistic(const CoilDetectorSetup& setup, Thresholds thresholds, double cycle = 0);
  Lane Period(const MeasuredPeriod& in) override;

  const ResistanceEstimate& resistance() const { return resistance_; }

 private:
  SlopeCircuit CircuitOf(int j, const MeasuredPeriod& in, const MovingPermeance& P) const;
  double EvaluateStatistic(int j, const MeasuredPeriod& in, const MovingPermeance& P);

  LinkageModel model_;
  DetectorSettings s_;
  Thresholds thresholds_;
  SlopeConverter converter_;
  MovingPermeance centred_;
  ResistanceEstimate resistance_;
  std::vector<long> codes_;
  Lane held_;
  double cycle_, since_ = 0;  // [s]
};

}  // namespace ambrig
