#pragma once
/// A current that changes faster than any healthy coil's can, period after period. The inductance
/// of a coil is never below its leakage, whatever the iron does, so that its current moves by V
/// h/L_leak between two samples at most. A coil that has lost most of its turns moves by many times
/// that, its current loop is no longer stable, and its readings reach the end of their range: c is
/// not judged there, and the currents that swing with it mislead what is said of its neighbours. No
/// circuit is needed to name it.
///
/// A step that occurs once (a sensor's, a current that vanishes) is none of these.
#include "fdd/measurement/period_slopes.h"

namespace ambrig {

class CurrentSwing {
 public:
  /// `noise`: of a sample, quantisation included [A rms].
  CurrentSwing(const LinkageModel& nominal, const SamplingSettings& sampling, double noise);

  /// One period; `step`: the largest steps of its samples, up or down, `reading`: the largest of
  /// them [A], `share`: turns that every coil is believed to have, 0: not watched [-]. The coil
  /// that has swung in six of the last sixteen periods, the one of the largest steps; -1: none.
  int Period(const MeasuredPeriod& in, const Lane& step, const Lane& reading, const Lane& share);
  /// Whether some current has swung in four of the last six periods: nothing is to be concluded
  /// of the others.
  bool unsettled() const { return unsettled_; }
  /// Share of its turns that a coil with such steps has lost [-]: its steps over those of its calm
  /// periods are its inductances', as the square of the turns. 0.5 to 0.95.
  double Lost(int coil) const;
  void Forget();

  struct Steps {
    Lane limit, over;  // V h/L_leak [A]; how many times that is a swing
    Lane usual, calm;  // mean of the largest steps while calm [A], periods of it
  };

 private:
  /// What the coils' swings so far say, after one more period.
  int Count();

  LinkageModel nominal_;
  SamplingSettings sampling_;
  double noise_;  // of a step [A]
  Lane step_;     // largest of the period [A]
  Steps steps_;
  unsigned recent_[kLanes] = {};  // a bit per period, the last one lowest
  double over_[kLanes] = {};      // largest step over the limit, in those periods
  bool unsettled_ = false;
  bool calm_ = true;  // no coil has swung in those periods
};

}  // namespace ambrig
