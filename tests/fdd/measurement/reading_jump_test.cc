// Steps of a reading that no voltage can make, on the simulator's own stator.
#include "fdd/measurement/reading_jump.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

struct ReadingBench {
  Bench bench;
  ReadingJump jump{MakeLinkageModel(Reference()), bench.Sampling(), 0.004};
  ReadingBench() { bench.noise = 0.004; }
};

TEST(ReadingJump, RippleNoiseAndHardSwitchingAreNone) {
  ReadingBench b;
  for (int n = 0; n < 200; ++n) {
    for (int j = 0; j < kLanes; ++j) b.bench.duty[j] = (n + j) % 3 == 0 ? 0.2 : 0.65;
    const Lane jumps = b.jump.Period(b.bench.Run());
    for (int j = 0; j < kLanes; ++j) EXPECT_EQ(jumps[j], 0) << n << " " << j;
  }
}

TEST(ReadingJump, AStepOfTheOffsetIsSeenOnceWithItsSizeAndASpikeIsNot) {
  ReadingBench b;
  double offset = 0;
  for (int n = 0; n < 30; ++n) {
    MeasuredPeriod in = b.bench.Run();
    for (int k = 0; k < kSamples; ++k) {
      if (n == 10 && k == 7) offset = 0.3;
      b.bench.adc[k][5] += offset;
    }
    if (n == 20) b.bench.adc[9][2] += 1.0;
    const Lane jumps = b.jump.Period(in);
    for (int j = 0; j < kLanes; ++j) {
      if (n == 10 && j == 5)
        EXPECT_NEAR(jumps[j], 0.3, 0.06);
      else
        EXPECT_EQ(jumps[j], 0) << n << " " << j;
    }
  }
}

// Behind the three intervals that an edge may reach an on phase has one more, or three. Of one
// nothing is known: there only a step beyond what the bus can do would be a false one.
TEST(ReadingJump, OfASingleIntervalNothingIsKnown) {
  for (const int intervals : {1, 3}) {
    ReadingBench b;
    double offset = 0, largest = 0;
    for (int n = 0; n < 30; ++n) {
      b.bench.duty[5] = (2.5 + intervals) / kSamples;
      MeasuredPeriod in = b.bench.Run();
      in.bus *= 2;  // that could drive the current twice as fast
      for (int k = 0; k < kSamples; ++k) {
        if (n == 20 && k == 3) offset = 0.24;
        b.bench.adc[k][5] += offset;
      }
      largest = std::max(largest, b.jump.Period(in)[5]);
    }
    EXPECT_NEAR(largest, intervals == 1 ? 0 : 0.24, 0.06) << intervals;
  }
}

}  // namespace
}  // namespace ambrig
