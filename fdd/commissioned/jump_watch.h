#pragma once
/// Current sensors whose offset steps: a reading jumps by what no voltage can make, afterwards all
/// slopes are right. Two indications: the jump itself (reading_jump.h), and the current that misses
/// its set-point to the same side in the next period. It comes once: where any reading has jumped
/// shortly before or jumps soon after, currents swing (a current loop on half of the turns has four
/// times its gain). A fault of the coil itself shows in its slopes within a few periods and is
/// decided there.
#include "fdd/measurement/reading_jump.h"

namespace ambrig {

class JumpWatch {
 public:
  JumpWatch(const LinkageModel& nominal, const SamplingSettings& sampling, double noise);

  /// One period; `now`: c of every coil in it, `conducts` as of ReadingJump::Period. Returns the
  /// coil whose sensor stepped, -1: none.
  int Period(const MeasuredPeriod& in, const Lane& now, bool conducts = false);
  /// Another explanation was found.
  void Forget() { coil_ = -1; }
  /// Largest steps of the last period, up or down [A].
  const Lane& largest() const { return jump_.largest(); }
  double onset() const { return onset_; }
  /// By what its reading stepped in the last period that no voltage can make [A].
  double jump(int coil) const { return jumps_[coil]; }

 private:
  bool Confirmed(const MeasuredPeriod& in) const;

  ReadingJump jump_;
  Lane jumps_;
  int coils_ = 0, samples_ = 0;
  int coil_ = -1, periods_ = 0;
  int quiet_ = 1000;             // periods in which no reading jumped
  double step_ = 0, onset_ = 0;  // [A], [s]
  double excess_ = 0;            // sum of its c
};

}  // namespace ambrig
