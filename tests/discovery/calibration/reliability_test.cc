// Reliability, calibration error and shares against numbers worked out by hand.
#include "discovery/calibration/reliability.h"

#include <gtest/gtest.h>

#include "core/math/noise.h"

namespace ambrig {
namespace {

TEST(Reliability, BinsHoldTheirUpperEdge) {
  const auto bins = ReliabilityDiagram({{0, false}, {0.1, true}, {0.100001, false}, {1, true}}, 10);
  ASSERT_EQ(bins.size(), 10U);
  EXPECT_EQ(bins[0].count, 2U);
  EXPECT_DOUBLE_EQ(bins[0].stated, 0.05);
  EXPECT_DOUBLE_EQ(bins[0].found, 0.5);
  EXPECT_EQ(bins[1].count, 1U);
  EXPECT_EQ(bins[9].count, 1U);
  EXPECT_DOUBLE_EQ(bins[9].found, 1);
  EXPECT_EQ(bins[5].count, 0U);
}

// 2/5 |0.95 - 1/2| + 2/5 |0.15 - 0| + 1/5 |0.55 - 1| = 0.18 + 0.06 + 0.09
TEST(Reliability, CalibrationErrorByHand) {
  const std::vector<JudgedStatement> all = {
      {0.95, true}, {0.95, false}, {0.15, false}, {0.15, false}, {0.55, true}};
  const CalibrationError e = ExpectedCalibrationError(all, 10);
  EXPECT_NEAR(e.value, 0.33, 1e-12);
  EXPECT_GT(e.sd, 0.05);
}

// Of n statements at p = 1/2 the share found is off by E|K/n - 1/2| = C(n, n/2)/2^(n+1), n even:
// 0.123 for n = 10.
TEST(Reliability, WhatChanceAloneGives) {
  const CalibrationError e =
      ExpectedCalibrationError(std::vector<JudgedStatement>(10, {0.5, true}), 10);
  EXPECT_NEAR(e.value, 0.5, 1e-12);
  EXPECT_EQ(e.sd, 0);  // every resample is the same
  // sd of one draw 0.095, of the mean of 400: 0.005
  EXPECT_NEAR(e.by_chance, 0.1230, 0.015);
}

TEST(Reliability, CertainStatementsHaveNoChance) {
  const CalibrationError e = ExpectedCalibrationError({{1, true}, {0, false}, {1, true}}, 10);
  EXPECT_EQ(e.value, 0);
  EXPECT_EQ(e.by_chance, 0);
}

// Wilson's interval of 8 in 10: 0.4902 to 0.9433 (z = 1.96).
TEST(Reliability, WilsonsInterval) {
  const Share s = ShareOf(8, 10);
  EXPECT_DOUBLE_EQ(s.value, 0.8);
  EXPECT_NEAR(s.lo, 0.4902, 1e-4);
  EXPECT_NEAR(s.hi, 0.9433, 1e-4);
  EXPECT_EQ(ShareOf(0, 0).lo, 0);
  EXPECT_EQ(ShareOf(0, 0).hi, 1);
  EXPECT_NEAR(ShareOf(0, 5).lo, 0, 1e-12);
  EXPECT_NEAR(ShareOf(5, 5).hi, 1, 1e-12);
}

}  // namespace
}  // namespace ambrig
