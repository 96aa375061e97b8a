// Steps of a reading that no voltage can make, on the simulator's own stator.
#include "fdd/measurement/reading_jump.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace ambrig
