#include "fdd/commissioned/jump_watch.h"

#include <cmath>

namespace ambrig {

namespace {
constexpr int kQuiet = 8;            // periods without a jump before it
constexpr int kPeriods = 6;          // after the jump, for the slopes to tell
constexpr double kMissed = 0.35;     // of the jump, in the period after it
constexpr double kRightSlope = 0.3;  // |c|, mean of the periods
}  // namespace

JumpWatch::JumpWatch(const LinkageModel& nominal, const SamplingSettings& sampling, double noise)
    : jump_(nominal, sampling, noise), coils_(nominal.coils), samples_(sampling.samples) {}

bool JumpWatch::Confirmed(const MeasuredPeriod& in) const {
  if (!in.set_point) return false;
  double mean = 0;
  for (int k = 0; k < samples_; ++k) mean += in.adc[k][coil_];
  return (mean / samples_ - (*in.set_point)[coil_]) / step_ > kMissed;
}

int JumpWatch::Period(const MeasuredPeriod& in, const Lane& now, bool conducts) {
  jumps_ = jump_.Period(in, conducts);
  double most = 0;
  int largest = -1;
  for (int j = 0; j < coils_; ++j)
    if (std::abs(jumps_[j]) > most) {
      most = std::abs(jumps_[j]);
      largest = j;
    }
  const bool quiet = quiet_ >= kQuiet;
  quiet_ = largest >= 0 ? 0 : quiet_ + 1;
  if (coil_ < 0) {
    if (largest >= 0 && quiet) {
      coil_ = largest;
      step_ = jumps_[largest];
    }
    periods_ = 0;
    excess_ = 0;
    onset_ = in.t;
    return -1;
  }
  // What jumps again is a current of its own shape, or swings with that of another coil. A loop may
  // take back in the next period what it made of the step.
  const bool again = ++periods_ == 1 ? jumps_[coil_] * step_ > 0 : largest >= 0;
  if (again || (periods_ == 1 && !Confirmed(in))) {
    coil_ = -1;
    return -1;
  }
  // The slopes of a period with a jump say nothing; those after it do.
  excess_ += now[coil_];
  if (periods_ < kPeriods) return -1;
  const int coil = coil_;
  coil_ = -1;
  return std::abs(excess_) < kRightSlope * kPeriods ? coil : -1;
}

}  // namespace ambrig
