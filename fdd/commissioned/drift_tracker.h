#pragma once
/// When slow drift (slow_drift.h) is followed: as long as nothing is doubted and every ratio of the
/// long windows is below 0.5. What has drifted while the machine stood still is in c
/// from the start: after the first 40 undisturbed periods, and after 160 more, it is taken off at
/// once, unless a shorter window is beyond its band or this one beyond 1.5 of it.
#include "fdd/commissioned/excess_bands.h"
#include "fdd/commissioned/excess_windows.h"
#include "fdd/commissioned/slow_drift.h"

namespace ambrig {

class DriftTracker {
 public:
  DriftTracker(const LinkageModel& nominal, const SamplingSettings& sampling, bool relies);

  /// Nothing is taken for drift from now on.
  void Ignore() { follows_ = false; }
  void TakeOff(SlopeExcess* period) const { drift_.TakeOff(period); }
  /// Whether drift since the commissioning was taken off at once in this period; the windows then
  /// have to begin again. `undisturbed`: no contact, no flux out of range, no bands widened.
  bool TakesFirst(bool undisturbed, const ExcessWindows& windows, const ExcessBands& bands);
  /// The `count`th period, in which nothing is doubted and no coil is suspect.
  void Follow(long long count, const ExcessWindows& windows, const ExcessBands& bands);
  const SlowDrift& drift() const { return drift_; }

 private:
  /// Whether |c| over window w is within `most` of its band for every coil.
  bool Within(double most, int w, const ExcessWindows& windows, const ExcessBands& bands) const;

  int coils_;
  bool relies_;
  double interval_;  // between two steps [s]
  SlowDrift drift_;
  bool follows_ = true;
  std::size_t first_drifts_ = 0;  // how many of both were looked at
  long long steady_ = 0;          // undisturbed periods in a row, until then
};

}  // namespace ambrig
