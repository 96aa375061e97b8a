// Positions between readings, and sensors that fail.
#include "fdd/measurement/position_monitor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/math/noise.h"

namespace ambrig {
namespace {

constexpr double kMonitorStep = 8e-5;  // [s]

/// A whirl of 50 µm at 40 Hz, axes x and y, read `count` times.
double Whirl(std::size_t axis, double t) {
  return 5e-5 * std::cos(2 * 3.14159265 * 40 * t - 1.5707963 * static_cast<double>(axis));
}
void ReadWhirl(PositionMonitor& m, int from, int to) {
  for (int k = from; k < to; ++k)
    m.Read(k * kMonitorStep, {Whirl(0, k * kMonitorStep), Whirl(1, k * kMonitorStep)});
}

// Between and after the readings the error is that of the third derivative: r (w h)^3/6 and some.
TEST(PositionFollower, FollowsAWhirlToThirdOrder) {
  PositionMonitor m(2, 1e-5);
  ReadWhirl(m, 0, 20);
  EXPECT_DOUBLE_EQ(m.step(), kMonitorStep);
  const double wh = 2 * 3.14159265 * 40 * kMonitorStep;
  for (const double u : {0.0, 0.5, 1.0}) {
    const double t = (19 + u) * kMonitorStep;
    for (std::size_t a = 0; a < 2; ++a)
      EXPECT_NEAR(m.At(a, t), Whirl(a, t), 5e-5 * std::pow(wh, 3) * (u + 0.01)) << u;
  }
  EXPECT_EQ(m.Recent(0, 0), Whirl(0, 19 * kMonitorStep));
  EXPECT_EQ(m.Recent(1, 2), Whirl(1, 17 * kMonitorStep));
  EXPECT_THAT(m.TakeNewFaults(), ::testing::IsEmpty());
}

// With fewer than three readings there is no parabola: the newest one is held.
TEST(PositionFollower, HoldsTheNewestReadingUntilThereAreThree) {
  PositionMonitor m(1, 1e-5);
  m.Read(0, {1e-5});
  m.Read(kMonitorStep, {2e-5});
  EXPECT_EQ(m.At(0, 3 * kMonitorStep), 2e-5);
  EXPECT_EQ(m.Recent(0, 1), 2e-5);
  EXPECT_FALSE(m.ready(kMonitorStep));
  m.Read(2 * kMonitorStep, {4e-5});
  EXPECT_TRUE(m.ready(2 * kMonitorStep));
  EXPECT_FALSE(m.ready(9 * kMonitorStep));  // too long without a reading
  EXPECT_NEAR(m.At(0, 3 * kMonitorStep), 7e-5,
              1e-15);  // 1, 2, 4, 7: second difference of 1
  EXPECT_EQ(m.Recent(0, 1), 2e-5);
}

TEST(PositionFollower, TheSameInstantIsNoNewReading) {
  PositionMonitor m(1, 1e-5);
  EXPECT_TRUE(m.Read(0, {1e-5}));
  EXPECT_FALSE(m.Read(0, {9e-5}));
  EXPECT_EQ(m.At(0, 0), 1e-5);
}

TEST(PositionFault, AJumpThatNoForceCouldMakeIsAFault) {
  PositionMonitor m(2, 1e-5);
  ReadWhirl(m, 0, 30);
  m.Read(30 * kMonitorStep, {Whirl(0, 30 * kMonitorStep), Whirl(1, 30 * kMonitorStep) + 1.2e-5});
  EXPECT_FALSE(m.faulty(0));
  EXPECT_TRUE(m.faulty(1));
  EXPECT_THAT(m.TakeNewFaults(), ::testing::ElementsAre(1));
  EXPECT_THAT(m.TakeNewFaults(), ::testing::IsEmpty());  // told once
  EXPECT_NEAR(m.Departure(1), 1.2e-5, 1e-6);
  ReadWhirl(m, 31, 60);
  EXPECT_TRUE(m.faulty(1));  // it does not heal by itself
  EXPECT_LT(m.Departure(1), 1e-6);
}

TEST(PositionFault, WhatAnImpactMayAddIsAllowed) {
  PositionMonitor m(1, 1e-5);
  for (int k = 0; k < 30; ++k) m.Read(k * kMonitorStep, {Whirl(0, k * kMonitorStep)});
  m.Read(30 * kMonitorStep, {Whirl(0, 30 * kMonitorStep) + 1.2e-5}, {5e-6});
  EXPECT_FALSE(m.faulty(0));
  EXPECT_THAT(m.TakeNewFaults(), ::testing::IsEmpty());
}

// The cable of a plane breaks.
TEST(PositionFault, TwoSensorsThatFailInOneReadingAreBothTold) {
  PositionMonitor m(2, 1e-5);
  ReadWhirl(m, 0, 30);
  m.Read(30 * kMonitorStep,
         {1e-4 + Whirl(0, 30 * kMonitorStep), 1e-4 + Whirl(1, 30 * kMonitorStep)});
  EXPECT_THAT(m.TakeNewFaults(), ::testing::ElementsAre(0, 1));
  EXPECT_THAT(m.TakeNewFaults(), ::testing::IsEmpty());
}

// A large step in the first readings is where the rotor stands, not a fault.
TEST(PositionFault, TheFirstReadingsAreNoJump) {
  PositionMonitor m(1, 1e-6);
  m.Read(0, {0});
  m.Read(kMonitorStep, {1e-4});
  m.Read(2 * kMonitorStep, {1e-4});
  m.Read(3 * kMonitorStep, {1e-4});
  EXPECT_FALSE(m.faulty(0));
}

// The very same reading again and again, after readings that never were: frozen.
TEST(PositionFault, AFrozenReadingIsFoundOnceReadingsWereSeenToDiffer) {
  PositionMonitor m(2, 1);
  for (int k = 0; k < 60; ++k)
    m.Read(k * kMonitorStep, {1e-7 * Normal(1, 0, static_cast<std::uint64_t>(k)), 0.0});
  EXPECT_FALSE(m.faulty(1));  // a channel that never moved says nothing
  for (int k = 60; k < 66; ++k) {
    EXPECT_FALSE(m.faulty(0)) << k;
    m.Read(k * kMonitorStep, {5e-8, 0.0});
  }
  EXPECT_FALSE(m.faulty(0));  // five equal neighbours
  m.Read(66 * kMonitorStep, {5e-8, 0.0});
  EXPECT_TRUE(m.faulty(0));
  EXPECT_FALSE(m.faulty(1));
}

// A departure counts beyond six times the noise of y - 3 y1 + 3 y2 - y3, whose variance is 20.
TEST(PositionFault, NoiseIsTakenOffADeparture) {
  const double noise = 1e-7;
  PositionMonitor quiet(1, 1, 0), noisy(1, 1, noise);
  for (int k = 0; k < 20; ++k) {
    quiet.Read(k * kMonitorStep, {0});
    noisy.Read(k * kMonitorStep, {0});
  }
  quiet.Read(20 * kMonitorStep, {1e-5});
  noisy.Read(20 * kMonitorStep, {1e-5});
  EXPECT_NEAR(quiet.Departure(0) - noisy.Departure(0), 6 * std::sqrt(20.0) * noise, 1e-15);
  quiet.Read(21 * kMonitorStep, {1e-5});
  EXPECT_NEAR(quiet.Departure(0), 2e-5, 1e-15);  // the largest of the last three
}

}  // namespace
}  // namespace ambrig
