// Readings that step by what no voltage can make, with and without the witnesses that make it a
// fault of the sensor.
#include "fdd/commissioned/jump_watch.h"

#include <gtest/gtest.h>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

struct JumpBench {
  Bench bench;
  JumpWatch watch{MakeLinkageModel(Reference()), bench.Sampling(), 0.004};
  Lane offset;     // of the readings [A]
  Lane set_point;  // the currents of the first period
  Lane c;          // that the slopes show

  JumpBench() {
    bench.noise = 0.004;
    bench.x0 = bench.y0 = 0;
    bench.Run();
    set_point = bench.adc[kSamples / 2];
    Run(5);
  }
  /// Coil that was named in one of the periods, -1: none.
  int Run(int periods) {
    int named = -1;
    for (int n = 0; n < periods; ++n) {
      MeasuredPeriod in = bench.Run();
      // Mean of the healthy currents: the loop follows them.
      for (int j = 0; j < kLanes; ++j) {
        set_point[j] = 0;
        for (const Lane& sample : bench.adc) set_point[j] += sample[j] / kSamples;
      }
      for (Lane& sample : bench.adc)
        for (int j = 0; j < kLanes; ++j) sample[j] += offset[j];
      in.set_point = &set_point;
      const int now = watch.Period(in, c);
      if (now >= 0) named = now;
    }
    return named;
  }
};

TEST(JumpWatch, AStepOfAnOffsetIsTheSensors) {
  for (const double step : {0.8, -0.8, 0.4}) {
    JumpBench b;
    b.offset[5] = step;
    EXPECT_EQ(b.Run(10), 5) << step;
    EXPECT_GT(b.watch.onset(), 0);
  }
}

TEST(JumpWatch, NothingIsSaidOfQuietReadings) {
  JumpBench b;
  EXPECT_EQ(b.Run(200), -1);
}

// A step that the voltage can make is none.
TEST(JumpWatch, ASmallStepIsNotSeen) {
  JumpBench b;
  b.offset[5] = 0.05;
  EXPECT_EQ(b.Run(20), -1);
}

// The slopes after the step are wrong: it is a fault of the coil, which is decided elsewhere.
TEST(JumpWatch, AStepWithWrongSlopesIsNotTheSensors) {
  JumpBench b;
  b.offset[5] = 0.8;
  b.c[5] = 1.5;
  EXPECT_EQ(b.Run(10), -1);
}

// A loop that follows the step was no step of a sensor alone.
TEST(JumpWatch, AStepThatIsGoneInTheNextPeriodIsForgotten) {
  JumpBench b;
  b.offset[5] = 0.8;
  EXPECT_EQ(b.Run(1), -1);
  b.offset[5] = 0;
  EXPECT_EQ(b.Run(10), -1);
  b.offset[2] = 0.8;  // and the next one is seen
  EXPECT_EQ(b.Run(10), 2);
}

// A loop that has lost turns swings, and takes others with it.
TEST(JumpWatch, CurrentsThatSwingAreNoSensors) {
  JumpBench b;
  for (int n = 0; n < 12; ++n) {
    const double swing = n % 4 < 2 ? 0.8 : -0.8;
    b.offset[2] = swing;
    b.offset[5] = n == 0 ? 0 : -0.5 * swing;
    EXPECT_EQ(b.Run(1), -1) << n;
  }
  EXPECT_EQ(b.Run(20), -1);
}

TEST(JumpWatch, AnotherExplanationEndsIt) {
  JumpBench b;
  b.offset[5] = 0.8;
  EXPECT_EQ(b.Run(3), -1);
  b.watch.Forget();
  EXPECT_EQ(b.Run(20), -1);
}

TEST(JumpWatch, TheLargestOfSeveralStepsIsWatched) {
  JumpBench b;
  b.offset[1] = 0.5;
  b.offset[6] = -0.9;
  EXPECT_EQ(b.Run(10), 6);
}

}  // namespace
}  // namespace ambrig
