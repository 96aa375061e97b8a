/// The position loop: discrete closed forms of the PID, its limits, and the current map.
#include "control/position/pid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "control/current/current_map.h"

namespace ambrig {
namespace {

constexpr double kPidTs = 80e-6;
constexpr PidParameters kPidGains = {4e5, 900, 6e6, 1.5e-4, 60};  // reference rig

double Step(const PidParameters& p, double Ts, double y, double r, double excitation, PidState& s) {
  return PidStep(p, Ts, PidFilter(p, Ts), y, r, excitation, s);
}

// A step of the reading: d_k = (1-a) Δ/Ts a^(k), the derivative's own impulse response.
TEST(Pid, DerivativeOfAStep) {
  const PidParameters p = {0, 900, 0, 1.5e-4, 1e9};
  PidState s;
  Step(p, kPidTs, 1e-6, 0, 0, s);
  const double a = std::exp(-kPidTs / 1.5e-4);
  for (int k = 0; k < 20; ++k) {
    const double f = Step(p, kPidTs, 3e-6, 0, 0, s);
    EXPECT_NEAR(f, -900 * (1 - a) * 2e-6 / kPidTs * std::pow(a, k), 1e-12) << k;
  }
}

// A ramp: d_k = v (1 - a^k); a moving reference makes no derivative.
TEST(Pid, DerivativeOfARamp) {
  const PidParameters p = {0, 900, 0, 1.5e-4, 1e9};
  PidState s;
  const double a = std::exp(-kPidTs / 1.5e-4), v = 0.01;
  for (int k = 0; k < 30; ++k) {
    const double f = Step(p, kPidTs, v * k * kPidTs, 7e-6 * k, 0, s);
    EXPECT_NEAR(f, -900 * v * (1 - std::pow(a, k)), 1e-12) << k;
  }
}

// f uses the integral before this step's increment: f_n = kp e + n ki Ts e.
TEST(Pid, IntegralIsOneStepLate) {
  PidState s;
  const double e = 2e-6;
  for (int n = 0; n < 10; ++n)
    EXPECT_NEAR(Step(kPidGains, kPidTs, 0, e, 0, s), 4e5 * e + n * 6e6 * kPidTs * e, 1e-14) << n;
}

// The increment is dropped when the raw force, excitation included, is beyond the limit where e
// pushes.
TEST(Pid, ClampAndAntiWindup) {
  PidState s;
  EXPECT_EQ(Step(kPidGains, kPidTs, 0, 2e-4, 0, s), 60);  // 80 N asked for
  EXPECT_EQ(s.integral, 0);
  EXPECT_EQ(Step(kPidGains, kPidTs, 0, -2e-4, 0, s), -60);
  EXPECT_EQ(s.integral, 0);
  EXPECT_EQ(Step(kPidGains, kPidTs, 0, 1e-6, 100, s), 60);  // the excitation alone
  EXPECT_EQ(s.integral, 0);
  EXPECT_EQ(Step(kPidGains, kPidTs, 0, -1e-6, 100, s), 60);  // e pulls back: it counts
  EXPECT_NEAR(s.integral, -6e6 * kPidTs * 1e-6, 1e-18);
  EXPECT_NEAR(Step(kPidGains, kPidTs, 0, 0, 5, s), 5 - 6e6 * kPidTs * 1e-6, 1e-14);
}

TEST(Pid, HoldGivesTheForceAtRest) {
  DecentralisedPid pid({kPidGains, kPidGains}, kPidTs);
  pid.Hold({12, -3}, {5e-6, 0}, {5e-6, 0});
  std::vector<double> f(2);
  pid.Step({5e-6, 0}, {5e-6, 0}, {0, 0}, 0, f);
  EXPECT_EQ(f[0], 12);
  EXPECT_EQ(f[1], -3);
}

CurrentMap Healthy() {
  CurrentMap m;
  m.k = 16;
  m.c0 = 2;
  m.i_max = 6;
  for (int j = 0; j < 8; ++j) {
    const double angle = (22.5 + 45 * j) * std::acos(-1.0) / 180;
    m.W.row(j) << 1, std::cos(angle), std::sin(angle);
  }
  return m;
}

// i = c0 + v cos γ, v = f/(k c0): 32 N an ampere.
TEST(CurrentMap, HealthySetPoints) {
  const auto i = Healthy().SetPoints(32, -16);
  for (int j = 0; j < 8; ++j) {
    const double angle = (22.5 + 45 * j) * std::acos(-1.0) / 180;
    EXPECT_NEAR(i[j], 2 + std::cos(angle) - 0.5 * std::sin(angle), 1e-14);
  }
}

TEST(CurrentMap, ClampsToWhatTheBridgeCanDo) {
  CurrentMap m = Healthy();
  auto i = m.SetPoints(320, 0);
  EXPECT_EQ(i[0], 6);
  EXPECT_EQ(i[4], 0);
  m.unipolar = false;
  i = m.SetPoints(320, 0);
  EXPECT_EQ(i[4], -6);
}

}  // namespace
}  // namespace ambrig
