// Sensor effects against their closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "core/math/constants.h"
#include "tests/effects/motion_rig.h"

namespace ambrig::motion {
namespace {

MotionState At(double x, double y) {
  MotionState s;
  s.q[0] = x;
  s.q[1] = y;
  return s;
}

TEST(MotionSensor, GainDoesNotScaleTheOffsetWhateverTheOrder) {
  const Named gain = {"sensor-gain", "A.y", {{"gain", 1.1}}},
              offset = {"sensor-offset", "A.y", {{"offset", 3e-6}}};
  for (const auto& order : {std::vector{gain, offset}, std::vector{offset, gain}}) {
    Plant plant = PlantOf(order);
    const auto [x, y] = Reading(plant, 0, At(7e-6, 1e-5));
    EXPECT_EQ(x, 7e-6);
    EXPECT_NEAR(y, 1.1 * 1e-5 + 3e-6, 1e-20);
    EXPECT_EQ(Reading(plant, 1, At(7e-6, 1e-5)).second, 1e-5) << "the other plane is untouched";
  }
}

TEST(MotionSensor, AxisZIsTheThrustBearing) {
  Plant plant = PlantOf({{"sensor-gain", "z", {{"gain", 2}}}});
  MotionState s = At(1e-5, 1e-5);
  s.q[2] = 4e-5;
  EXPECT_EQ(Reading(plant, 0, s).first, 1e-5);
  EXPECT_EQ(Reading(plant, 2, s).first, 8e-5);
}

TEST(MotionSensor, RotationReadsTheTurnedAxes) {
  const double a = 0.3;
  Plant plant = PlantOf({{"sensor-rotation", "A", {{"angle", a}}}});
  const auto [x, y] = Reading(plant, 0, At(2e-5, -1e-5));
  EXPECT_NEAR(x, 2e-5 * std::cos(a) - 1e-5 * std::sin(a), 1e-20);
  EXPECT_NEAR(std::hypot(x, y), std::hypot(2e-5, 1e-5), 1e-20);  // a rotation keeps lengths
  Plant back = PlantOf(
      {{"sensor-rotation", "A", {{"angle", a}}}, {"sensor-rotation", "A", {{"angle", -a}}}});
  EXPECT_NEAR(Reading(back, 0, At(2e-5, -1e-5)).second, -1e-5, 1e-20);
}

TEST(MotionSensor, RunoutIsASurfaceThatTurnsWithTheRotor) {
  Plant plant =
      PlantOf({{"sensor-runout", "A", {{"c1", 3e-6}, {"s1", 1e-6}, {"c2", 5e-7}, {"s2", -2e-7}}}});
  MotionState s;
  EXPECT_NEAR(Reading(plant, 0, s).first, 3e-6 + 5e-7, 1e-20);   // a = theta = 0
  EXPECT_NEAR(Reading(plant, 0, s).second, 1e-6 - 5e-7, 1e-20);  // a = 90 degrees: s1 - c2
  for (const double theta : {0.4, 2.0, 5.5}) {
    s.theta = theta;
    const double x = Reading(plant, 0, s).first;
    MotionState later = s;
    later.theta = theta + kPi / 2;  // the y probe sees the same spot a quarter turn later
    EXPECT_NEAR(Reading(plant, 0, later).second, x, 1e-19);
    later = s;
    later.Omega = 2000;
    later.Omega_dot = 50;
    EXPECT_EQ(Reading(plant, 0, later).first, x) << "no dependence on the speed";
  }
}

/// Complex gain of the low-pass for a sine sampled every 40 us.
std::complex<double> Response(double frequency, double cutoff, const std::string& target,
                              std::size_t bearing) {
  Plant plant = PlantOf({{"sensor-lowpass", target, {{"cutoff", cutoff}}}});
  std::complex<double> sum = 0;
  const int period = static_cast<int>(std::lround(25000 / frequency)), skip = 100 * period;
  for (int n = 0; n < skip + period; ++n) {
    MotionState s;
    s.t = n * 4e-5;
    const double phase = 2 * kPi * frequency * s.t;
    s.q[0] = std::cos(phase);
    const double y = Reading(plant, bearing, s).first;
    if (n >= skip) sum += 2.0 / period * y * std::polar(1.0, -phase);
  }
  return sum;
}

TEST(MotionSensor, LowpassHasItsCutoff) {
  // Between samples the input is taken as straight: sinc²(f T) = 1 - (pi f T)²/3 at 500 Hz is
  // 0.0013 off.
  const std::complex<double> h = Response(500, 500, "A", 0);
  EXPECT_NEAR(std::abs(h), std::sqrt(0.5), 1.4e-3);
  EXPECT_NEAR(std::arg(h), -kPi / 4, 1.4e-3);
  EXPECT_NEAR(std::abs(Response(500, 500, "rig", 1) - h), 0, 1e-12);
  EXPECT_NEAR(std::abs(Response(500, 500, "A", 1)), 1, 1e-9) << "target A leaves B alone";
}

TEST(MotionSensor, LowpassFollowsARampLateByItsTimeConstant) {
  Plant plant = PlantOf({{"sensor-lowpass", "A", {{"cutoff", 800}}}});
  const double tau = 1 / (2 * kPi * 800);
  for (int n = 0; n < 1000; ++n) {
    MotionState s;
    s.t = n * 4e-5;
    s.q[0] = 0.3 * s.t;
    const double exact =
        0.3 * (s.t - tau * (1 - std::exp(-s.t / tau)));  // settled at the first sample
    EXPECT_NEAR(Reading(plant, 0, s).first, exact, 1e-15);
  }
}

TEST(MotionSensor, HumIsTheSameOnBothSensorsAndFixedInRecordTime) {
  Plant plant = PlantOf({{"sensor-hum", "B", {{"frequency", 50}, {"c", 1e-6}, {"s", -2e-6}}}});
  MotionState s;
  EXPECT_NEAR(Reading(plant, 1, s).first, 1e-6, 1e-20);
  s.t = 0.005;  // a quarter period
  EXPECT_NEAR(Reading(plant, 1, s).second, -2e-6, 1e-19);
  s.t = -0.02 + 1.0 / 300;
  EXPECT_NEAR(Reading(plant, 1, s).first,
              std::sqrt(5.0) * 1e-6 * std::cos(kPi / 3 + std::atan(2.0)), 1e-18);
  EXPECT_EQ(Reading(plant, 0, s).first, 0);
}

}  // namespace
}  // namespace ambrig::motion
