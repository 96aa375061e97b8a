// Bands and ranges are those of the healthy run, nothing else.
#include "fdd/commissioned/healthy_bands.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

/// 400 periods of a bench with noise and 2 % of iron, duties that follow a slow tone, set-points
/// that are missed by `miss`.
CommissioningLog Healthy(Bench& bench, double miss) {
  bench.noise = 0.004;
  bench.lanes.reluctance.iron_path = 0.02 * Reference().gap;
  CommissioningLog log(kSamples);
  for (int n = 0; n < 400; ++n) {
    for (int j = 0; j < kLanes; ++j) bench.duty[j] = 0.515 + 0.01 * std::sin(0.05 * n + j);
    MeasuredPeriod in = bench.Run();
    Lane set_point;
    for (int j = 0; j < kLanes; ++j) {
      for (const Lane& sample : bench.adc) set_point[j] += sample[j] / kSamples;
      set_point[j] += miss * (j + 1);
    }
    in.set_point = &set_point;
    log.Add(in);
  }
  return log;
}

TEST(HealthyBands, HoldEveryPeriodOfTheRunThatMadeThem) {
  Bench bench;
  const CommissioningLog log = Healthy(bench, 0.05);
  const CoilDetectorSetup setup = SetupOf(bench);
  CommissionedBearing learnt = NominalBearing("A", setup.model);
  learnt.learnt = true;
  AddHealthyBands(setup, log, &learnt);
  for (int j = 0; j < kLanes; ++j) {
    EXPECT_NEAR(learnt.current_error[j], 0.05 * (j + 1), 1e-9) << j;
    EXPECT_GT(learnt.largest_flux[j], 0);
    for (int w = 0; w < kExcessWindows; ++w) EXPECT_GT(learnt.largest[w][j], 0) << w << " " << j;
    EXPECT_GT(learnt.largest[0][j], learnt.largest[4][j]);  // noise averages out
  }
  CommissionedDetector again(setup, learnt);
  for (std::size_t n = 0; n < log.size(); ++n) {
    const auto seen = again.Watch(log.At(n));
    EXPECT_FALSE(seen.decided) << n;
    if (n >= 200) {  // before that nothing counted
      EXPECT_FALSE(seen.doubtful) << n;
    }
  }
}

// Outside the flux that was commissioned the same readings are doubted.
TEST(HealthyBands, ARangeThatWasNotVisitedIsDoubted) {
  Bench bench;
  const CommissioningLog log = Healthy(bench, 0);
  const CoilDetectorSetup setup = SetupOf(bench);
  CommissionedBearing learnt = NominalBearing("A", setup.model);
  learnt.learnt = true;
  AddHealthyBands(setup, log, &learnt);
  for (double& v : learnt.largest_flux.v) v *= 0.9;
  CommissionedDetector narrow(setup, learnt);
  int doubted = 0;
  for (std::size_t n = 0; n < log.size(); ++n) doubted += narrow.Watch(log.At(n)).doubtful;
  EXPECT_GT(doubted, 20);
}

}  // namespace
}  // namespace ambrig
