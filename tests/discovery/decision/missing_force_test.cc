// The law of a missing force, from samples of a motion that knows nothing of it.
#include "discovery/decision/missing_force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/math/constants.h"
#include "core/math/noise.h"

namespace ambrig {
namespace {

/// Two incommensurate wobbles and a rotation at 37 Hz (every second sample backwards), force by a
/// law, noise of 0.1 N.
ForceSamples Samples(
    const std::function<std::pair<double, double>(const ForceSamples&, std::size_t)>& law,
    bool back_and_forth = false) {
  ForceSamples s;
  s.radius = 0.03;
  for (std::size_t k = 0; k < 3000; ++k) {
    const double t = 2e-4 * static_cast<double>(k);
    s.t.push_back(t);
    s.omega.push_back(2 * kPi * (back_and_forth && k % 2 == 1 ? -37 : 37));
    s.theta.push_back(2 * kPi * 37 * t);
    const double a = 2 * kPi * 11.3 * t, b = 2 * kPi * 23.7 * t + 1;
    s.x.push_back(2e-5 * std::sin(a) + 1e-5 * std::sin(b));
    s.y.push_back(1.5e-5 * std::cos(1.3 * a) - 1e-5 * std::sin(0.7 * b));
    s.vx.push_back(2e-5 * 2 * kPi * 11.3 * std::cos(a) + 1e-5 * 2 * kPi * 23.7 * std::cos(b));
    s.vy.push_back(-1.5e-5 * 1.3 * 2 * kPi * 11.3 * std::sin(1.3 * a) -
                   1e-5 * 0.7 * 2 * kPi * 23.7 * std::cos(0.7 * b));
    const auto [fx, fy] = law(s, k);
    s.fx.push_back(fx + 0.7 + 0.1 * Normal(5, 1, k));
    s.fy.push_back(fy - 0.3 + 0.1 * Normal(5, 2, k));
  }
  return s;
}

TEST(MissingForce, LinearInPosition) {
  const MissingForce f = FindLaw(Samples([](const ForceSamples& s, std::size_t k) {
                                   return std::pair{-6e4 * s.y[k], 6e4 * s.x[k]};
                                 }),
                                 "A");
  EXPECT_EQ(f.on, "position (linear)");
  EXPECT_GT(f.share, 0.9);
  EXPECT_NE(f.formula.find("target = \"A\""), std::string::npos);
}

TEST(MissingForce, DampingIsNoStiffness) {
  const MissingForce f = FindLaw(Samples([](const ForceSamples& s, std::size_t k) {
                                   return std::pair{-400 * s.vx[k], -400 * s.vy[k]};
                                 }),
                                 "A");
  EXPECT_EQ(f.on, "velocity (linear)");
}

TEST(MissingForce, TurnsTwiceWithTheRotor) {
  const MissingForce f =
      FindLaw(Samples([](const ForceSamples& s, std::size_t k) {
                return std::pair{std::cos(2 * s.theta[k]), std::sin(2 * s.theta[k])};
              }),
              "B");
  EXPECT_EQ(f.on, "angle of rotation, order 2");
}

std::pair<double, double> Rub(const ForceSamples& s, std::size_t k, double angle, double gap,
                              double on) {
  const double depth =
      std::max(0.0, s.x[k] * std::cos(angle) + s.y[k] * std::sin(angle) - gap) * on;
  return {-4e5 * depth * std::cos(angle), -4e5 * depth * std::sin(angle)};
}

TEST(MissingForce, ContactAtAClockPosition) {
  const MissingForce f = FindLaw(
      Samples([](const ForceSamples& s, std::size_t k) { return Rub(s, k, -2.1, 8e-6, 1); }), "B");
  EXPECT_TRUE(f.on.starts_with("position on one side: something pushes back from -120") ||
              f.on.find("from -12") != std::string::npos)
      << f.on;
  EXPECT_EQ(f.on.find("every"), std::string::npos) << f.on;
  EXPECT_GT(f.share, 0.9);
}

TEST(MissingForce, ContactThatComesAndGoes) {
  const MissingForce f = FindLaw(Samples([](const ForceSamples& s, std::size_t k) {
                                   const double u = s.t[k] / 0.11 - 0.2;
                                   return Rub(s, k, 0.9, -4e-6, u - std::floor(u) < 0.4 ? 1 : 0);
                                 }),
                                 "B");
  const auto at = f.on.find("every ");
  ASSERT_NE(at, std::string::npos) << f.on;
  EXPECT_NEAR(std::stod(f.on.substr(at + 6)), 0.11, 0.004);
  EXPECT_NEAR(std::stod(f.on.substr(f.on.find("from ") + 5)), 0.9 * 180 / kPi, 6);
  EXPECT_GT(f.share, 0.7);
}

// Half of the samples from a rotor that turns backwards: friction drags it the other way.
TEST(MissingForce, FrictionFollowsTheSliding) {
  const double angle = 0.4;
  const MissingForce f = FindLaw(
      Samples(
          [&](const ForceSamples& s, std::size_t k) {
            const auto [x, y] = Rub(s, k, angle, -3e-6, 1);
            const double push = -(x * std::cos(angle) + y * std::sin(angle)),
                         mu = 0.3 * (s.omega[k] > 0 ? 1 : -1);
            return std::pair{x + mu * push * std::sin(angle), y - mu * push * std::cos(angle)};
          },
          true),
      "B");
  EXPECT_GT(f.share, 0.95);
  EXPECT_NEAR(std::stod(f.formula.substr(f.formula.find("mu = { value = ") + 15)), 0.3, 0.03)
      << f.formula;
}

TEST(MissingForce, ContactOfTheRotorsHighSpot) {
  const MissingForce f =
      FindLaw(Samples([](const ForceSamples& s, std::size_t k) {
                return Rub(s, k, -2.1, 4e-6 - 1.5e-5 * std::cos(s.theta[k] - 1), 1);
              }),
              "B");
  EXPECT_NE(f.on.find("high spot"), std::string::npos) << f.on;
  EXPECT_NEAR(std::stod(f.on.substr(f.on.find("from ") + 5)), -2.1 * 180 / kPi, 3);
  EXPECT_GT(f.share, 0.95);
}

}  // namespace
}  // namespace ambrig
