// White noise told from what a wrong model leaves, on signals that are known.
#include "discovery/data/noise_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "core/math/noise.h"

namespace ambrig {
namespace {

constexpr std::size_t kRows = 8000;
constexpr double kRate = 12500;  // [Hz]

double Estimate(const std::vector<double>& error) {
  const std::vector<char> ok(error.size(), 1);
  return WhiteNoiseOf(error.data(), ok.data(), error.size());
}

TEST(WhiteNoise, OfPureNoiseIsItsSd) {
  std::vector<double> y(kRows);
  for (std::size_t k = 0; k < kRows; ++k) y[k] = 0.02 * Normal(3, 1, k);
  EXPECT_NEAR(Estimate(y), 0.02, 0.001);
}

// A misfit a hundred times the noise at 50 Hz, ten times at 900 Hz, a drift and three steps.
TEST(WhiteNoise, IgnoresWhatAModelGetsWrong) {
  std::vector<double> y(kRows);
  for (std::size_t k = 0; k < kRows; ++k) {
    const double t = static_cast<double>(k) / kRate;
    y[k] = 0.02 * Normal(3, 1, k) + 2 * std::sin(2 * kPi * 50 * t) +
           0.2 * std::sin(2 * kPi * 900 * t) + 5 * t + (k > 3000 ? 0.7 : 0) - (k > 6000 ? 1.1 : 0);
  }
  EXPECT_NEAR(Estimate(y), 0.02, 0.002);
}

// Half of the fourth differences of a coarse converter's column are zero; the step's own noise,
// LSB/sqrt(12), is the least that can be said.
TEST(WhiteNoise, OfACoarseConverterIsNotNothing) {
  std::vector<double> y(kRows);
  for (std::size_t k = 0; k < kRows; ++k)
    y[k] = std::round((0.05 * Normal(3, 1, k) + 3 * std::sin(2e-3 * static_cast<double>(k))) / 1.0);
  const double sd = Estimate(y);
  EXPECT_GT(sd, 0.02);
  EXPECT_LT(sd, 0.4);
}

TEST(WhiteNoise, SamplesLeftOutDoNotCount) {
  std::vector<double> y(kRows);
  std::vector<char> ok(kRows, 1);
  for (std::size_t k = 0; k < kRows; ++k) {
    y[k] = 0.02 * Normal(3, 1, k);
    if (k % 50 == 7) y[k] = 1e30, ok[k] = 0;
  }
  EXPECT_NEAR(WhiteNoiseOf(y.data(), ok.data(), kRows), 0.02, 0.001);
  EXPECT_TRUE(std::isnan(WhiteNoiseOf(y.data(), ok.data(), 20)));
}

TEST(Quantiles, OfAFewNumbers) {
  EXPECT_DOUBLE_EQ(MedianOf({5, 1, 3}), 3);
  EXPECT_DOUBLE_EQ(MedianOf({4, 1, 3, 2}), 2.5);
  EXPECT_DOUBLE_EQ(LowerQuartileOf({8, 0, 4, 6, 2}), 2);
  EXPECT_TRUE(std::isnan(MedianOf({std::nan("")})));
}

}  // namespace
}  // namespace ambrig
