#pragma once
/// What slow drift adds to the relative excess c of healthy coils (slope_excess.h): sensors that
/// move their zero, copper and iron that warm. Followed with a time constant of 0.2 s and taken off
/// c before anything is judged, in two parts with bounds of their own:
///
///   common   the fit of [1, cos, sin] over the coils, at most 0.10 at any coil: 20 um of a gap of
///            400 um. A single coil's fault leaves 5/8 of itself outside it
///   own      what a coil has beside that, at most 0.03
///
/// A short of 10 % of the turns has c = 0.23: no more than 0.12 of it can be learnt, however slowly
/// it grows, and only while the rest is below half of the band.
#include "fdd/circuit/slope_excess.h"

namespace ambrig {

class SlowDrift {
 public:
  static constexpr double kMostCommon = 0.10, kMostOwn = 0.03;  // |c|
  static constexpr double kTimeConstant = 0.2;                  // [s]

  /// `c`: what is left of every coil's c after expected(), `common`: its part that is common to the
  /// bearing; seen over the last `seconds`, in which nothing was suspect.
  void Follow(const Lane& c, const Lane& common, double seconds);
  /// c that drift alone gives every coil.
  const Lane& expected() const { return expected_; }
  /// Takes it off the sums of a period.
  void TakeOff(SlopeExcess* period) const;

 private:
  Lane common_, own_, expected_;
};

}  // namespace ambrig
