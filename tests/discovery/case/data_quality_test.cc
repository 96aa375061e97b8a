// Columns of a measurement with one thing wrong each, and what is left of them.
#include "discovery/case/data_quality.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ambrig {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// 1000 rows of a sine of amplitude 1 that repeats no value next to itself.
std::vector<double> Sine() {
  std::vector<double> y(1000);
  for (std::size_t k = 0; k < y.size(); ++k) y[k] = std::sin(0.1 * static_cast<double>(k) + 0.3);
  return y;
}

std::size_t Counting(const ChannelQuality& q) {
  return static_cast<std::size_t>(std::count(q.ok.begin(), q.ok.end(), 1));
}

TEST(ChannelQuality, AWholeColumnIsGood) {
  const ChannelQuality q = InspectChannel({"A.x", "m", Sine()}, false);
  EXPECT_EQ(q.channel, "A.x");
  EXPECT_EQ(q.verdict, "good");
  EXPECT_TRUE(q.use);
  EXPECT_EQ(Counting(q), 1000u);
}

// A sine may stay at its top for a few rows; a limiter holds four at least, and again and again.
TEST(ChannelQuality, RunsOfFourRowsAtTheExtremeAreClipped) {
  for (const std::size_t rows : {3u, 4u}) {
    std::vector<double> y = Sine();
    for (const std::size_t at : {100u, 400u, 700u})
      for (std::size_t k = 0; k < rows; ++k) y[at + k] = 1.01;
    const ChannelQuality q = InspectChannel({"A.x", "m", y}, false);
    EXPECT_EQ(Counting(q), rows < 4 ? 1000u : 988u) << rows;
  }
}

// nan and inf alike do not count; their neighbours do.
TEST(ChannelQuality, WhatIsNoNumberDoesNotCount) {
  std::vector<double> y = Sine();
  y[0] = kNan;
  y[17] = kInf;
  y[999] = -kInf;
  const ChannelQuality q = InspectChannel({"A.x", "m", y}, false);
  EXPECT_TRUE(q.use);
  EXPECT_EQ(q.missing, 3u);
  EXPECT_EQ(q.verdict, "3 samples missing, left out");
  EXPECT_EQ(Counting(q), 997u);
  EXPECT_EQ(q.ok[17], 0);
  EXPECT_EQ(q.ok[16], 1);
  y = Sine();
  y[5] = kNan;
  EXPECT_EQ(InspectChannel({"A.x", "m", y}, false).verdict, "1 sample missing, left out");
}

TEST(ChannelQuality, AColumnWithoutANumberIsEmpty) {
  for (const std::vector<double>& y : {std::vector<double>(20, kNan), std::vector<double>()}) {
    const ChannelQuality q = InspectChannel({"A.x", "m", y}, true);
    EXPECT_FALSE(q.use);
    EXPECT_THAT(q.verdict, HasSubstr("empty"));
    EXPECT_EQ(Counting(q), 0u);
  }
}

// A constant is a stuck column, unless it is what a clamped rotor or a stiff bus does.
TEST(ChannelQuality, AConstantColumnIsStuckUnlessItMayBeConstant) {
  std::vector<double> y(50, 0.5);
  y[3] = kNan;
  ChannelQuality q = InspectChannel({"A.i1", "A", y}, false);
  EXPECT_FALSE(q.use);
  EXPECT_EQ(q.verdict, "stuck at 0.5: left out");
  q = InspectChannel({"A.i1", "A", y}, true);
  EXPECT_TRUE(q.use);
  EXPECT_EQ(q.verdict, "good (constant)");
  EXPECT_EQ(Counting(q), 49u);
}

// A signal cut at a limit stands still at its own extremes; both ends count, the rest is kept.
TEST(ChannelQuality, AClippedColumnLosesItsFlatTopsOnly) {
  std::vector<double> y = Sine();
  for (double& v : y) v = std::clamp(v, -0.8, 0.9);
  const auto flat = static_cast<std::size_t>(
      std::count_if(y.begin(), y.end(), [](double v) { return v == -0.8 || v == 0.9; }));
  const ChannelQuality q = InspectChannel({"A.x", "m", y}, false);
  EXPECT_TRUE(q.use);
  EXPECT_NEAR(static_cast<double>(q.clipped), static_cast<double>(flat), 6);
  EXPECT_THAT(q.verdict, HasSubstr("clipped in"));
  EXPECT_EQ(Counting(q), 1000 - q.clipped);
  for (std::size_t k = 0; k < y.size(); ++k) {
    if (y[k] != -0.8 && y[k] != 0.9) {
      EXPECT_EQ(q.ok[k], 1) << k;
    }
  }
}

// Both faults of one column are said: the owner has two things to mend.
TEST(ChannelQuality, MissingAndClippedAreBothSaid) {
  std::vector<double> y = Sine();
  for (double& v : y) v = std::min(v, 0.7);
  y[40] = kNan;
  y[41] = kNan;
  const ChannelQuality q = InspectChannel({"A.x", "m", y}, false);
  EXPECT_EQ(q.missing, 2u);
  EXPECT_GT(q.clipped, 0u);
  EXPECT_THAT(q.verdict, HasSubstr("2 samples missing"));
  EXPECT_THAT(q.verdict, HasSubstr("clipped in"));
  EXPECT_EQ(q.ok[40], 0);
}

// The steps of a converter repeat values anywhere; that is no clipping.
TEST(ChannelQuality, AQuantisedColumnIsGood) {
  std::vector<double> y = Sine();
  for (double& v : y) v = std::round(v * 100) / 100;
  const ChannelQuality q = InspectChannel({"A.x", "m", y}, false);
  EXPECT_EQ(q.clipped, 0u);
  EXPECT_EQ(Counting(q), 1000u);
  EXPECT_EQ(q.verdict, "good");
}

// Set-points that a limit holds are commanded so.
TEST(ChannelQuality, WhatMayBeConstantIsNotCalledClipped) {
  std::vector<double> y = Sine();
  for (double& v : y) v = std::clamp(v, -0.5, 0.5);
  EXPECT_EQ(InspectChannel({"A.s1", "A", y}, true).verdict, "good");
}

}  // namespace
}  // namespace ambrig
