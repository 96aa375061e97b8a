/// Centralised control: translation and tilt do not mix, gyroscopic moments are cancelled.
#include "control/position/tilt_translation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ambrig {
namespace {

constexpr double kTiltTs = 80e-6;
const CoordinateGains kTranslation{8e5, 1800, 1e7, 1.5e-4}, kTilt{1.2e4, 27, 2e5, 1.5e-4};
const TiltTranslationGeometry kPlaces{{-0.135, 0.145}, {-0.12, 0.13}, 0.0042};

TiltTranslation MakeTilt(double gyro = 0) {
  return TiltTranslation(kTranslation, kTilt, gyro, kPlaces, {1e9, 1e9, 1e9, 1e9}, kTiltTs);
}

// Readings of a pure shift give forces without moment about the centre of mass; of a pure tilt,
// without a sum.
TEST(TiltTranslation, Decouples) {
  std::vector<double> f(4);
  TiltTranslation k = MakeTilt();
  k.Step({2e-6, 0, 2e-6, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, 0, f);
  EXPECT_NEAR(f[0] + f[2], -kTranslation.kp * 2e-6, 1e-9);
  EXPECT_NEAR(-0.12 * f[0] + 0.13 * f[2], 0, 1e-12);
  EXPECT_EQ(f[1], 0);
  TiltTranslation t = MakeTilt();
  const double theta = 1e-5;
  t.Step({0, -0.135 * theta, 0, 0.145 * theta}, {0, 0, 0, 0}, {0, 0, 0, 0}, 0, f);
  EXPECT_NEAR(f[1] + f[3], 0, 1e-12);
  EXPECT_NEAR(-0.12 * f[1] + 0.13 * f[3], -kTilt.kp * theta, 1e-9);
  EXPECT_EQ(f[0], 0);
}

// A tilt rate in x-z makes the moment g Omega Ip theta' in y-z against the gyroscopic one, and the
// other way round.
TEST(TiltTranslation, CancelsTheGyroscopicMoment) {
  const double Omega = 1000, rate = 0.02;
  TiltTranslation with = MakeTilt(1), without = MakeTilt(0);
  std::vector<double> f(4), g(4);
  for (int k = 0; k < 60; ++k) {
    const double theta = rate * kTiltTs * k;
    const std::vector<double> y{-0.135 * theta, 0, 0.145 * theta, 0}, none(4, 0.0);
    with.Step(y, none, none, Omega, f);
    without.Step(y, none, none, Omega, g);
  }
  const double moment = -0.12 * (f[1] - g[1]) + 0.13 * (f[3] - g[3]);  // theta_y = -alpha
  EXPECT_NEAR(moment, -Omega * kPlaces.inertia_polar * rate, 1e-9);
  EXPECT_NEAR(f[0], g[0], 1e-12);
}

TEST(TiltTranslation, HoldsForcesAndIsItsLinearModel) {
  TiltTranslation k = MakeTilt(0.8);
  std::vector<double> f(4);
  k.Hold({1, -20, 3, -18}, {0, 0, 0, 0}, {0, 0, 0, 0});
  k.Step({0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, 500, f);
  const std::vector<double> wanted{1, -20, 3, -18};
  for (std::size_t a = 0; a < 4; ++a) EXPECT_NEAR(f[a], wanted[a], 1e-12);
  k.Hold({0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0});
  const StateSpace s = k.Linear(500);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(s.states());
  for (int n = 0; n < 80; ++n) {
    std::vector<double> y(4);
    Eigen::VectorXd u(4);
    for (std::size_t a = 0; a < 4; ++a)
      u[static_cast<Eigen::Index>(a)] = y[a] =
          1e-6 * std::sin(0.1 * n * static_cast<double>(a + 1));
    k.Step(y, {0, 0, 0, 0}, {0, 0, 0, 0}, 500, f);
    const Eigen::VectorXd v = s.C * x + s.D * u;
    for (std::size_t a = 0; a < 4; ++a)
      EXPECT_NEAR(f[a], v[static_cast<Eigen::Index>(a)], 1e-9) << n;
    x = (s.A * x + s.B * u).eval();
  }
}

// Clamped, the integrals of the plane stop.
TEST(TiltTranslation, AntiWindup) {
  TiltTranslation k(kTranslation, kTilt, 0, kPlaces, {10, 10, 10, 10}, kTiltTs);
  std::vector<double> f(4);
  for (int n = 0; n < 1000; ++n) k.Step({-1e-3, 0, -1e-3, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, 0, f);
  EXPECT_EQ(f[0], 10);
  // the derivative dies out
  for (int n = 0; n < 40; ++n) k.Step({0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, 0, f);
  EXPECT_NEAR(f[0], 0, 1e-3);
}

}  // namespace
}  // namespace ambrig
