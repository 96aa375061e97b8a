#include "fdd/commissioned/current_swing.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "actuators/magnetics/lane_vector.h"

namespace ambrig {

namespace {

// Over V h/L_leak: the neighbours' flux adds to the voltage, and 60 % of the turns lost in iron
// that is all eddy currents make 6 of it.
constexpr double kOverLeakage = 2, kFarOver = 12;
constexpr double kFarBelow = 0.8;          // of the largest set-point
constexpr double kNoiseOfSwing = 11;       // 8 sd of the difference of two samples
constexpr unsigned kWindow = 0xffff;       // sixteen periods: they need not follow each other
constexpr unsigned kRecent = 0x3f;         // six periods
constexpr int kNamed = 6, kUnsettled = 4;  // of the sixteen, of the six: what a circuit explains
// is told by it before
constexpr double kUsualPeriods = 64;  // over which the steps of a calm coil are averaged
constexpr double kLeastLostBySwing = 0.5, kMostLostBySwing = 0.95;  // of the turns

AMBRIG_WIDE void LargestSteps(const Lane* adc, int samples, Lane* last, Lane* step, Lane* reading) {
  LaneVector before = Load(last->v), most = 0.0, highest = 0.0;
  for (int k = 0; k < samples; ++k) {
    const LaneVector now = Load(adc[k].v);
    most = Max(Abs(now - before), most);
    highest = Max(now, highest);
    before = now;
  }
  Store(last->v, before);
  Store(step->v, most);
  Store(reading->v, highest);
}

}  // namespace

CurrentSwing::CurrentSwing(const LinkageModel& nominal, const SamplingSettings& sampling,
                           double noise)
    : nominal_(nominal), sampling_(sampling), noise_(kNoiseOfSwing * noise) {}

int CurrentSwing::Period(const MeasuredPeriod& in, const Lane& share) {
  if (!started_) last_ = in.adc[0];
  started_ = true;
  LargestSteps(in.adc, sampling_.samples, &last_, &largest_, &reading_);
  const double most = sampling_.amplifier->i_max;
  int named = -1;
  unsettled_ = false;
  for (int j = 0; j < nominal_.coils; ++j) {
    const double leakage = share[j] * share[j] * nominal_.leakage[j];
    const double limit = leakage > 0 ? in.bus * sampling_.step / leakage : kInfinity;
    const bool beyond = reading_[j] > most && in.set_point && (*in.set_point)[j] < kFarBelow * most;
    const bool swings = largest_[j] > (beyond ? kOverLeakage : kFarOver) * limit + noise_;
    recent_[j] = ((recent_[j] << 1) | (swings ? 1U : 0U)) & kWindow;
    if (recent_[j] == 0) over_[j] = 0;
    if (recent_[j] == 0)
      usual_[j] += (largest_[j] - usual_[j]) / std::min(++calm_[j], kUsualPeriods);
    if (swings) over_[j] = std::max(over_[j], largest_[j] / limit);
    const int often = std::popcount(recent_[j]);
    unsettled_ = unsettled_ || std::popcount(recent_[j] & kRecent) >= kUnsettled;
    if (often >= kNamed && (named < 0 || over_[j] > over_[named])) named = j;
  }
  return named;
}

double CurrentSwing::Lost(int coil) const {
  const double left = usual_[coil] > 0 ? usual_[coil] / largest_[coil] : 0;
  return std::clamp(1 - std::sqrt(left), kLeastLostBySwing, kMostLostBySwing);
}

void CurrentSwing::Forget() {
  std::fill_n(recent_, kLanes, 0U);
  std::fill_n(over_, kLanes, 0.0);
  unsettled_ = false;
}

}  // namespace ambrig
