#include "fdd/commissioned/slow_drift.h"

#include <algorithm>
#include <cmath>

#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

namespace {

template <class V>
[[gnu::always_inline]] inline void TakeOffAll(const Lane& expected, SlopeExcess* period) {
  for (int q = 0; q < 2; ++q)
    Store(period->top[q].v,
          LoadAs<V>(period->top[q].v) - LoadAs<V>(expected.v) * LoadAs<V>(period->bottom[q].v));
}
AMBRIG_WHOLE void TakeOffWhole(const Lane& expected, SlopeExcess* period) {
  TakeOffAll<WholeLaneVector>(expected, period);
}
AMBRIG_WIDE void TakeOffHalves(const Lane& expected, SlopeExcess* period) {
  TakeOffAll<LaneVector>(expected, period);
}

}  // namespace

void SlowDrift::Follow(const Lane& c, const Lane& common, double seconds) {
  const double rate = std::min(1.0, seconds / kTimeConstant);
  double most = kMostCommon;
  for (int j = 0; j < kLanes; ++j) {
    common_[j] += rate * common[j];
    most = std::max(most, std::abs(common_[j]));
    own_[j] = std::clamp(own_[j] + rate * (c[j] - common[j]), -kMostOwn, kMostOwn);
  }
  for (int j = 0; j < kLanes; ++j) {
    common_[j] *= kMostCommon / most;
    expected_[j] = common_[j] + own_[j];
  }
}

void SlowDrift::TakeOff(SlopeExcess* period) const {
  (whole_lanes ? TakeOffWhole : TakeOffHalves)(expected_, period);
}

}  // namespace ambrig
