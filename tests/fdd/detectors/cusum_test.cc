// CUSUM against published run lengths and Siegmund's approximation.
#include "fdd/detectors/cusum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/noise.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

/// Mean samples until the two-sided CUSUM exceeds h, and its standard error.
void RunLength(double shift, double drift, double h, double* mean, double* error) {
  constexpr int kRuns = 4000;
  double sum = 0, square = 0;
  for (int run = 0; run < kRuns; ++run) {
    Cusum c;
    c.drift = drift;
    double n = 0;
    float r[64];
    for (std::uint64_t block = 0;; ++block) {
      FillNormals(static_cast<std::uint64_t>(run) + 1, 3, block, r, 64);
      bool over = false;
      for (int k = 0; k < 64 && !over; ++k) {
        n += 1;
        over = c.Add(static_cast<double>(r[k]) + shift) > h;
      }
      if (over) break;
    }
    sum += n;
    square += n * n;
  }
  *mean = sum / kRuns;
  *error = std::sqrt((square / kRuns - *mean * *mean) / kRuns);
}

// Montgomery, Introduction to Statistical Quality Control, table of ARL for k = 1/2 and h = 4.
TEST(Cusum, RunLengthsArePublishedOnes) {
  const double published[][2] = {{0, 168}, {0.5, 26.6}, {1, 8.38}, {2, 3.34}};
  for (const auto& [shift, arl] : published) {
    double mean = 0, error = 0;
    RunLength(shift, 0.5, 4, &mean, &error);
    EXPECT_NEAR(mean, arl, 4 * error + 0.01) << shift;
  }
}

TEST(Cusum, SiegmundsApproximation) {
  for (double h : {3.0, 4.0}) {
    double mean = 0, error = 0;
    RunLength(0, 0.5, h, &mean, &error);
    const double one = CusumRunLength(0, 0.5, h);
    // both sides; Siegmund: within about 1 %
    EXPECT_NEAR(mean, one / 2, 0.03 * mean + 4 * error) << h;
  }
  double mean = 0, error = 0;
  RunLength(1, 0.5, 5, &mean, &error);
  EXPECT_NEAR(mean, 1 / (1 / CusumRunLength(1, 0.5, 5) + 1 / CusumRunLength(-1, 0.5, 5)),
              0.03 * mean + 4 * error);
  EXPECT_NEAR(CusumRunLength(0.5, 0.5, 4), std::pow(5.166, 2), 1e-6);
  EXPECT_NEAR(CusumRunLength(0.5 + 1e-5, 0.5, 4), std::pow(5.166, 2), 1e-2);  // no jump at D = 0
}

TEST(Cusum, SeesBothSignsAlike) {
  Cusum up, down;
  for (int k = 0; k < 7; ++k) {
    up.Add(1.5);
    down.Add(-1.5);
  }
  EXPECT_DOUBLE_EQ(up.statistic(), 7.0);
  EXPECT_DOUBLE_EQ(down.statistic(), 7.0);
}

TEST(CusumDetector, QuietOnAHealthyStatorAndNamesTheBrokenCoil) {
  testing_bench::Bench bench;
  bench.noise = 0.004;
  CusumDetector detector(testing_bench::SetupOf(bench));
  for (int n = 0; n < 50; ++n)
    for (double s : detector.Period(bench.Run()).v) EXPECT_LT(s, 3);
  bench.lanes.Break(2, bench.x0, bench.y0);
  const Lane s = detector.Period(bench.Run());
  EXPECT_GT(s[2], 10);
  for (int j = 0; j < kLanes; ++j) {
    if (j == 2) continue;
    EXPECT_LT(s[j], 3) << j;
  }
}

}  // namespace
}  // namespace ambrig
