/// The speed sensor: pulses counted and timed, missed ones, the timer's clock, lag, standstill.
#include "rotor/motion/speed_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/math/constants.h"

namespace ambrig {
namespace {

constexpr double kT = 40e-6;  // between two readings [s]

MotionState At(double t, double theta, double Omega) {
  MotionState s;
  s.t = t;
  s.theta = theta;
  s.Omega = Omega;
  return s;
}

/// Readings of a shaft that turns evenly, one per period, from the first revolution on.
std::vector<double> Even(const SpeedSensorParameters& p, double Omega, double duration) {
  SpeedSensor sensor(p);
  sensor.Start(At(0, 0.1, Omega), 7);
  std::vector<double> out;
  for (int n = 1; n * kT < duration; ++n) {
    const double theta = 0.1 + Omega * n * kT;
    sensor.Read(At(n * kT, theta, Omega));
    if (std::abs(theta) > 2 * kPi) out.push_back(sensor.reading());
  }
  EXPECT_GT(out.size(), 100u);
  return out;
}

TEST(SpeedSensor, AnIdealOneReadsTheSpeedItself) {
  for (double v : Even({}, 1234.5678, 0.1)) EXPECT_EQ(v, 1234.5678);
}

TEST(SpeedSensor, PulsesOfAnEvenlyTurningWheelGiveItsSpeedBothWays) {
  for (double Omega : {157.0, -157.0, 6283.0})  // the last one: 60 pulses in 1 ms
    for (double v : Even({.pulses_per_revolution = 60}, Omega, 0.2))
      EXPECT_NEAR(v, Omega, 1e-9 * std::abs(Omega));
}

// Both times of an interval are rounded down to the clock: its length is wrong by less than a tick.
TEST(SpeedSensor, TheClockLimitsTheResolution) {
  const double Omega = 300, clock = 1e-6, interval = 2 * kPi / 60 / Omega;
  std::set<double> seen;
  for (double v : Even({.pulses_per_revolution = 60, .clock = clock}, Omega, 0.5)) {
    EXPECT_LE(v, Omega * interval / (interval - clock) * (1 + 1e-6));
    EXPECT_GE(v, Omega * interval / (interval + clock) * (1 - 1e-6));
    seen.insert(std::round(v * 1e6));
  }
  EXPECT_EQ(seen.size(), 2u);  // floor and ceiling of the interval in ticks
}

// After k missed pulses in a row the next interval is k + 1 times as long.
TEST(SpeedSensor, MissedPulsesHalveTheReadingUntilTheNextOne) {
  const double Omega = 200;
  double low = 0, n = 0;
  for (double v : Even({.pulses_per_revolution = 20, .missed_pulses = 0.2}, Omega, 20)) {
    EXPECT_LE(v, Omega * (1 + 1e-9));
    low += v < 0.9 * Omega ? 1 : 0;
    n += 1;
  }
  // Of the time the share behind a missed pulse, until a seen one follows a seen one: 1 - (1 - p)²,
  // less the part of the interval in which the time since the last pulse is not yet long enough.
  EXPECT_GT(low / n, 0.2);
  EXPECT_LT(low / n, 1 - 0.8 * 0.8 + 0.02);
}

TEST(SpeedSensor, AtAStandstillTheReadingFallsAsTheTimeSinceTheLastPulseAllows) {
  SpeedSensor sensor({.pulses_per_revolution = 60});
  sensor.Start(At(0, 0, 100), 1);
  double t = 0, theta = 0;
  for (; t < 0.1; t += kT, theta += 100 * kT) sensor.Read(At(t, theta, 100));
  EXPECT_NEAR(sensor.reading(), 100, 1e-6);
  for (int n = 0; n < 25000; ++n) sensor.Read(At(t += kT, theta, 0));
  EXPECT_GT(sensor.reading(), 0);
  EXPECT_LT(sensor.reading(), 2 * kPi / 60 / (25000 * kT) * 1.001);
}

TEST(SpeedSensor, TheLagIsOfFirstOrder) {
  SpeedSensor sensor({.lag = 0.02});
  sensor.Start(At(0, 0, 0), 1);
  for (int n = 1; n <= 1000; ++n) {
    sensor.Read(At(n * kT, 0, 50));
    EXPECT_NEAR(sensor.reading(), 50 * (1 - std::exp(-n * kT / 0.02)), 1e-9);
  }
}

TEST(SpeedSensor, TheSameSeedMissesTheSamePulses) {
  const SpeedSensorParameters p{.pulses_per_revolution = 20, .missed_pulses = 0.3};
  EXPECT_EQ(Even(p, 200, 1), Even(p, 200, 1));
}

}  // namespace
}  // namespace ambrig
