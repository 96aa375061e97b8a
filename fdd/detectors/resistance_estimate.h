#pragma once
/// Resistance of coils while they run: copper that warms up, drops that differ from
/// the nominal ones.
#include "fdd/detectors/coil_detector.h"

namespace ambrig {

/// Resistance of each coil from means with exponential forgetting: Σ v i / Σ i², started with the
/// nominal value. The linkage returns to where it was, so that its change drops out of the mean.
class ResistanceEstimate {
 public:
  explicit ResistanceEstimate(const CoilDetectorSetup& setup);

  void Add(const MeasuredPeriod& in);
  double Value(int j) const;  // [ohm], within half and twice the nominal one

 private:
  // [A²] weight of the nominal value: 40 ms at 2 A and 25 kHz
  static constexpr double kPrior = 4000;
  SamplingSettings sampling_;
  int coils_;
  Lane nominal_, top_, bottom_;
  double forget_;  // share a period
};

}  // namespace ambrig
