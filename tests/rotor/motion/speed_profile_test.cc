// Prescribed speed: piecewise linear, constant outside, its angle and acceleration by hand.
#include "rotor/motion/speed_profile.h"

#include <gtest/gtest.h>

namespace ambrig {
namespace {

// 0 to 2 s: 10 rad/s; to 4 s: up to 30; to 5 s: down to 0.
SpeedProfile UpAndDown() { return SpeedProfile({{0, 10}, {2, 10}, {4, 30}, {5, 0}}); }

TEST(SpeedProfile, SpeedIsLinearBetweenItsRows) {
  const SpeedProfile p = UpAndDown();
  EXPECT_EQ(p.Speed(-1), 10);
  EXPECT_EQ(p.Speed(1), 10);
  EXPECT_DOUBLE_EQ(p.Speed(3), 20);
  EXPECT_DOUBLE_EQ(p.Speed(4.5), 15);
  EXPECT_EQ(p.Speed(9), 0);
  EXPECT_EQ(p.end(), 5);
}

TEST(SpeedProfile, AccelerationIsTheSlopeOfEachSegmentAndNoneOutside) {
  const SpeedProfile p = UpAndDown();
  EXPECT_EQ(p.Acceleration(-1), 0);
  EXPECT_EQ(p.Acceleration(1), 0);
  EXPECT_DOUBLE_EQ(p.Acceleration(2), 10);
  EXPECT_DOUBLE_EQ(p.Acceleration(3.9), 10);
  EXPECT_DOUBLE_EQ(p.Acceleration(4), -30);
  EXPECT_EQ(p.Acceleration(5), 0);
}

// 20 rad in the first two seconds, 40 in the next two, 15 in the last: 0 at t = 0, also before the
// first row.
TEST(SpeedProfile, AngleIsTheIntegralOfTheSpeed) {
  const SpeedProfile p = UpAndDown();
  EXPECT_DOUBLE_EQ(p.Angle(0), 0);
  EXPECT_DOUBLE_EQ(p.Angle(-1), -10);
  EXPECT_DOUBLE_EQ(p.Angle(2), 20);
  EXPECT_DOUBLE_EQ(p.Angle(3), 35);
  EXPECT_DOUBLE_EQ(p.Angle(4), 60);
  EXPECT_DOUBLE_EQ(p.Angle(5), 75);
  EXPECT_DOUBLE_EQ(p.Angle(8), 75);
  const SpeedProfile late({{1, 4}, {3, 8}});
  EXPECT_DOUBLE_EQ(late.Angle(0), 0);
  EXPECT_DOUBLE_EQ(late.Angle(1), 4);
  EXPECT_DOUBLE_EQ(late.Angle(3), 16);
}

TEST(SpeedProfile, LargestSpeedLiesWithinTheRun) {
  const SpeedProfile up_and_down({{0.0, 0.0}, {1.0, -90.0}, {2.0, 0.0}, {3.0, 500.0}});
  EXPECT_EQ(up_and_down.LargestSpeed(2), 90);
  EXPECT_EQ(up_and_down.LargestSpeed(0.5), 45);
  EXPECT_EQ(SpeedProfile().LargestSpeed(1), 0);
}

}  // namespace
}  // namespace ambrig
