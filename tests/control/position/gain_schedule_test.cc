// Gains over the speed: linear between the points, held outside, even in the speed.
#include "control/position/gain_schedule.h"

#include <gtest/gtest.h>

#include <limits>

namespace ambrig {
namespace {

const std::vector<double> kSpeeds{0, 100, 400};  // [rad/s]

double ValueAt(const std::vector<double>& values, double Omega) {
  const ScheduleSpot s = Locate(kSpeeds, Omega);
  return s.weight == 0 ? values[s.low]
                       : (1 - s.weight) * values[s.low] + s.weight * values[s.low + 1];
}

TEST(GainSchedule, MeetsItsPointsAndIsLinearBetween) {
  const std::vector<double> values{5, 7, -2};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(ValueAt(values, kSpeeds[k]), values[k]);
  EXPECT_DOUBLE_EQ(ValueAt(values, 50), 6);
  EXPECT_DOUBLE_EQ(ValueAt(values, 25), 5.5);
  EXPECT_DOUBLE_EQ(ValueAt(values, 200), 4);
}

TEST(GainSchedule, KeepsItsEndsOutsideAndDoesNotKnowTheSense) {
  const std::vector<double> values{5, 7, -2};
  EXPECT_DOUBLE_EQ(ValueAt(values, 1e6), -2);
  EXPECT_DOUBLE_EQ(ValueAt(values, std::numeric_limits<double>::infinity()), -2);
  for (const double w : {3.0, 60.0, 100.0, 399.0, 800.0})
    EXPECT_EQ(ValueAt(values, w), ValueAt(values, -w));
}

TEST(GainSchedule, HasNoJumpAtAPoint) {
  const std::vector<double> values{5, 7, -2};
  for (const double w : kSpeeds)
    EXPECT_NEAR(ValueAt(values, w + 1e-9), ValueAt(values, w - 1e-9), 1e-9);
}

TEST(GainSchedule, StaysInsideItsPoints) {
  for (double w = -500; w < 500; w += 7.3) {
    const ScheduleSpot s = Locate(kSpeeds, w);
    EXPECT_LT(s.low + 1, kSpeeds.size());
    EXPECT_GE(s.weight, 0);
    EXPECT_LE(s.weight, 1);
  }
}

TEST(GainSchedule, OneSpeedIsThatEverywhere) {
  for (const double w : {-10.0, 0.0, 30.0, 1e4}) {
    const ScheduleSpot s = Locate({30}, w);
    EXPECT_EQ(s.low, 0u);
    EXPECT_EQ(s.weight, 0);
  }
}

TEST(PidSchedule, MixesEveryGain) {
  PidSchedule schedule;
  schedule.speeds = {0, 200};
  schedule.points.resize(2);
  double value = 1;
  for (const Field<PidParameters>& f : kPidFields) {
    schedule.points[0].*f.at = value;
    schedule.points[1].*f.at = 5 * value;
    value += 1;
  }
  value = 1;
  const PidParameters half = schedule.At(-100), quarter = schedule.At(50), end = schedule.At(900);
  for (const Field<PidParameters>& f : kPidFields) {
    EXPECT_DOUBLE_EQ(half.*f.at, 3 * value) << f.key;
    EXPECT_DOUBLE_EQ(quarter.*f.at, 2 * value) << f.key;
    EXPECT_DOUBLE_EQ(end.*f.at, 5 * value) << f.key;
    value += 1;
  }
}

}  // namespace
}  // namespace ambrig
