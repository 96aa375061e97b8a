// GLRT against its definition, its closed-form false-alarm rate and its delay for a known step.
#include "fdd/detectors/glrt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

TEST(Glrt, IsTheLargestOverAllTimesOfChange) {
  Glrt chart(10, 2);
  std::vector<std::array<double, 2>> all;
  for (std::uint64_t k = 0; k < 60; ++k) {
    float r[2];
    FillNormals(5, 1, k, r, 2);
    all.push_back({r[0], r[1] + (k > 30 ? 0.8 : 0)});
    double best = 0;
    for (std::size_t from = all.size() > 10 ? all.size() - 10 : 0; from < all.size(); ++from) {
      double a = 0, b = 0;
      for (std::size_t i = from; i < all.size(); ++i) {
        a += all[i][0];
        b += all[i][1];
      }
      best = std::max(best, (a * a + b * b) / (2 * static_cast<double>(all.size() - from)));
    }
    EXPECT_NEAR(chart.Add(all.back().data()), best, 1e-12 * (1 + best));
  }
}

// docs/theory/published_values.md 8: P(g > h) = erfc(sqrt h) for one channel; two channels: e^-h.
TEST(Glrt, FalseAlarmsOfOneWindowAreChiSquare) {
  constexpr int kSamples = 400000, kBlock = 500;
  for (int channels : {1, 2})
    for (double h : {1.0, 3.0, 5.0}) {
      Glrt chart(1, channels);
      std::vector<float> r(kBlock * 2);
      double over = 0;
      for (int block = 0; block < kSamples / kBlock; ++block) {
        FillNormals(11, 2, static_cast<std::uint64_t>(block), r.data(), 2 * kBlock);
        for (std::size_t k = 0; k < kBlock; ++k) {
          const double sample[2] = {r[2 * k], r[2 * k + 1]};
          over += chart.Add(sample) > h ? 1 : 0;
        }
      }
      const double p = channels == 1 ? std::erfc(std::sqrt(h)) : std::exp(-h);
      EXPECT_NEAR(over / kSamples, p, 4 * std::sqrt(p / kSamples)) << channels << " " << h;
    }
}

TEST(Glrt, DelayForAKnownStep) {
  constexpr double kStep = 1, kH = 12;
  constexpr int kRuns = 500;
  double sum = 0, square = 0;
  for (int run = 0; run < kRuns; ++run) {
    Glrt chart(100, 1);
    float r[300];
    FillNormals(static_cast<std::uint64_t>(run) + 1, 4, 0, r, 300);
    int k = 0;
    for (; k < 100; ++k) {  // healthy
      const double sample = r[k];
      chart.Add(&sample);
    }
    for (; k < 300; ++k) {
      const double sample = r[k] + kStep;
      if (chart.Add(&sample) > kH) break;
    }
    sum += k - 99;
    square += (k - 99) * (k - 99);
  }
  const double mean = sum / kRuns, error = std::sqrt((square / kRuns - mean * mean) / kRuns);
  // 2 h sigma²/mu² = 24 samples where S²/2m reaches h in the mean; E[S²/2m] = m mu²/2 + 1/2, so
  // that it does at 23, and the largest over m fluctuates upwards: earlier, not later.
  EXPECT_LT(mean, 24 + 4 * error);
  EXPECT_GT(mean, 0.75 * 24);
}

TEST(GlrtDetector, QuietOnAHealthyStatorAndNamesTheBrokenCoil) {
  testing_bench::Bench bench;
  bench.noise = 0.004;
  GlrtDetector detector(testing_bench::SetupOf(bench));
  for (int n = 0; n < 50; ++n)
    for (double s : detector.Period(bench.Run()).v) EXPECT_LT(s, 12);
  bench.lanes.Break(5, bench.x0, bench.y0);
  const Lane s = detector.Period(bench.Run());
  EXPECT_EQ(std::max_element(s.v, s.v + kLanes) - s.v, 5);
  EXPECT_GT(s[5], 50);
}

}  // namespace
}  // namespace ambrig
