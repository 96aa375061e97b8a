// When a coil is one without current: its reading is zero, its linkages do not move, and both are
// told beyond the noise of the readings.
#include "fdd/commissioned/coil_currents.h"

#include <gtest/gtest.h>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

constexpr int kWatched = 4;

struct CurrentsBench {
  testing_bench::Bench stator;
  CoilCurrents currents{MakeLinkageModel(testing_bench::Reference()), stator.Sampling(), 0.004};
  Lane set_point, share;
  FluxPeriod flux;

  CurrentsBench() {
    for (int j = 0; j < kLanes; ++j) {
      share[j] = 1;
      set_point[j] = 1;
      flux.largest[j] = j == kWatched ? 0.02 : 1;  // [A]
    }
  }
  /// One period in which c of the watched coil is `excess`, with the weight of its slopes.
  void Count(double excess, double weight) {
    MeasuredPeriod in = stator.Run();
    in.set_point = &set_point;
    SlopeExcess sums;
    sums.bottom[0][kWatched] = weight;
    sums.top[0][kWatched] = excess * weight;
    Lane c;
    c[kWatched] = excess;
    currents.CountWithout(in, flux, sums, c, share);
  }
};

TEST(CoilCurrents, ACoilWhoseLinkageStandsHasNoCurrentAfterThreePeriods) {
  CurrentsBench b;
  for (int n = 0; n < 2; ++n) b.Count(-0.95, 500);
  EXPECT_FALSE(b.currents.IsMissing(kWatched));
  b.Count(-0.95, 500);
  EXPECT_TRUE(b.currents.IsMissing(kWatched));
}

// A bridge that is on for a fifth of the period, on a large inductance: c of such a period has a
// deviation of 0.4, and three of them in a row below -0.5 are no open coil.
TEST(CoilCurrents, WhatFewSamplesSayOfASmallCurrentIsNotEnough) {
  CurrentsBench b;
  for (int n = 0; n < 3; ++n) b.Count(-0.7, 6);
  EXPECT_FALSE(b.currents.IsMissing(kWatched));
  b.Count(0.1, 6);
  for (int n = 0; n < 3; ++n) b.Count(-0.7, 6);
  EXPECT_FALSE(b.currents.IsMissing(kWatched));
  // An open coil goes on, and is told some periods later.
  for (int n = 0; n < 6; ++n) b.Count(-1, 6);
  EXPECT_TRUE(b.currents.IsMissing(kWatched));
}

}  // namespace
}  // namespace ambrig
