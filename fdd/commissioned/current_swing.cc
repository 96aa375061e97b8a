#include "fdd/commissioned/current_swing.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "actuators/magnetics/whole_lane_vector.h"

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

constexpr double kNever = 1e300, kLeast = 1e-300;  // no step reaches it; H

struct SwingInput {
  const Lane *step, *reading;  // the largest of the period [A]
  const Lane *set_point, *share, *leakage;
  double most, volt_seconds, noise;  // i_max [A], of a sample [Vs], of a step [A]
};

/// What the leakages allow. Returns whether some coil swings.
template <class V>
[[gnu::always_inline]] inline bool Compare(const SwingInput& in, CurrentSwing::Steps* steps) {
  const V share = LoadAs<V>(in.share->v), leakage = share * share * LoadAs<V>(in.leakage->v);
  const V limit = Select(leakage > V(0.0), V(in.volt_seconds) / Max(leakage, V(kLeast)), V(kNever));
  V over = kFarOver;
  if (in.set_point)
    over = Choose(Below(LoadAs<V>(in.set_point->v), kFarBelow * in.most) &
                      Below(in.most, LoadAs<V>(in.reading->v)),
                  kOverLeakage, over);
  Store(steps->limit.v, limit);
  Store(steps->over.v, over);
  return Largest(LoadAs<V>(in.step->v) - (over * limit + in.noise)) > 0;
}

/// Mean step of every coil, one more calm period.
template <class V>
[[gnu::always_inline]] inline void Average(const Lane& step, CurrentSwing::Steps* steps) {
  const V periods = LoadAs<V>(steps->calm.v) + V(1.0), usual = LoadAs<V>(steps->usual.v);
  Store(steps->calm.v, periods);
  Store(steps->usual.v, usual + (LoadAs<V>(step.v) - usual) / Min(periods, V(kUsualPeriods)));
}

template <class V>
[[gnu::always_inline]] inline bool Follow(const SwingInput& in, bool calm,
                                          CurrentSwing::Steps* steps) {
  if (Compare<V>(in, steps) || !calm) return false;
  Average<V>(*in.step, steps);
  return true;
}
AMBRIG_WHOLE bool FollowWhole(const SwingInput& in, bool calm, CurrentSwing::Steps* steps) {
  return Follow<WholeLaneVector>(in, calm, steps);
}
AMBRIG_WIDE bool FollowHalves(const SwingInput& in, bool calm, CurrentSwing::Steps* steps) {
  return Follow<LaneVector>(in, calm, steps);
}

}  // namespace

CurrentSwing::CurrentSwing(const LinkageModel& nominal, const SamplingSettings& sampling,
                           double noise)
    : nominal_(nominal), sampling_(sampling), noise_(kNoiseOfSwing * noise) {}

int CurrentSwing::Period(const MeasuredPeriod& in, const Lane& step, const Lane& reading,
                         const Lane& share) {
  unsettled_ = false;
  step_ = step;
  const SwingInput input{&step,
                         &reading,
                         in.set_point,
                         &share,
                         &nominal_.leakage,
                         sampling_.amplifier->i_max,
                         in.bus * sampling_.step,
                         noise_};
  if ((whole_lanes ? FollowWhole : FollowHalves)(input, calm_, &steps_)) return -1;
  return Count();
}

int CurrentSwing::Count() {
  int named = -1;
  calm_ = true;
  for (int j = 0; j < nominal_.coils; ++j) {
    const double largest = step_[j], limit = steps_.limit[j];
    const bool swings = largest > steps_.over[j] * limit + noise_;
    recent_[j] = ((recent_[j] << 1) | (swings ? 1U : 0U)) & kWindow;
    if (recent_[j] == 0) {
      over_[j] = 0;
      steps_.usual[j] += (largest - steps_.usual[j]) / std::min(++steps_.calm[j], kUsualPeriods);
      continue;
    }
    calm_ = false;
    if (swings) over_[j] = std::max(over_[j], largest / limit);
    unsettled_ = unsettled_ || std::popcount(recent_[j] & kRecent) >= kUnsettled;
    if (std::popcount(recent_[j]) >= kNamed && (named < 0 || over_[j] > over_[named])) named = j;
  }
  return named;
}

double CurrentSwing::Lost(int coil) const {
  const double left = steps_.usual[coil] > 0 ? steps_.usual[coil] / step_[coil] : 0;
  return std::clamp(1 - std::sqrt(left), kLeastLostBySwing, kMostLostBySwing);
}

void CurrentSwing::Forget() {
  std::fill_n(recent_, kLanes, 0U);
  std::fill_n(over_, kLanes, 0.0);
  calm_ = true;
  unsettled_ = false;
}

}  // namespace ambrig
