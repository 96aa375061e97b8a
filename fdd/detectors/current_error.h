#pragma once
/// Current-error threshold: the mean current of a period against its set-point, alarm after N
/// periods beyond the threshold in a row; here as the smallest error of the last N periods [A].
///
/// A healthy loop follows its set-point with a lag and no faster than the bus allows, so that only
/// the distance from the corridor between the set-point and such a follower counts:
///   p <- p + clamp((i_set - p) T kp/L, ± T U_d/L),
///     L of coils that switch together (slope_statistic.h)
/// Source: Loesch, ISMB8 2002 (threshold on |i_ref - i|), gated by the predicted slew
/// (docs/theory/published_values.md 8).
#include "fdd/detectors/coil_detector.h"

namespace ambrig {

class CurrentErrorDetector : public CoilDetector {
 public:
  static constexpr int kPeriods = 5;  // N
  explicit CurrentErrorDetector(const CoilDetectorSetup& setup);
  Lane Period(const MeasuredPeriod& in) override;

 private:
  SamplingSettings sampling_;
  int coils_;
  // share of the error followed in a period [-]; [A] at the nominal bus
  Lane lag_, slew_;
  Lane follower_;         // p [A]
  Lane error_[kPeriods];  // of the last periods [A]
  long long count_ = 0;
};

}  // namespace ambrig
