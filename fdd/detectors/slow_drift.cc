#include "fdd/detectors/slow_drift.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

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
  for (int q = 0; q < 2; ++q)
    for (int j = 0; j < kLanes; ++j) period->top[q][j] -= expected_[j] * period->bottom[q][j];
}

}  // namespace ambrig
