// A contact on one side, from samples whose contact is known: direction, gap, stiffness, friction.
#include "discovery/decision/side_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/noise.h"

namespace ambrig {
namespace {

/// A motion of two incommensurate circles [m] at 40 Hz of rotation, no force yet.
ForceSamples Motion(std::size_t rows = 1000) {
  ForceSamples s;
  s.radius = 0.02;
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = 2.5e-4 * static_cast<double>(k), a = 2 * kPi * 13.7 * t,
                 b = 2 * kPi * 29.3 * t;
    s.t.push_back(t);
    s.omega.push_back(2 * kPi * 40);
    s.theta.push_back(2 * kPi * 40 * t);
    s.x.push_back(2e-5 * std::cos(a) + 8e-6 * std::cos(b + 1));
    s.y.push_back(2e-5 * std::sin(a) - 8e-6 * std::sin(b));
    s.vx.push_back(0);
    s.vy.push_back(0);
  }
  s.fx.assign(rows, 0);
  s.fy.assign(rows, 0);
  return s;
}

/// Adds the contact's force and noise of `noise` [N].
void Push(ForceSamples& s, const SideContact& c, double noise) {
  for (std::size_t k = 0; k < s.t.size(); ++k) {
    const double n_x = std::cos(c.angle), n_y = std::sin(c.angle);
    const double depth = std::max(0.0, s.x[k] * n_x + s.y[k] * n_y +
                                           c.lobe * std::cos(s.theta[k] - c.high) - c.gap) *
                         c.On(s.t[k]);
    const double across = c.drag * depth * c.Rubs(s, k);
    s.fx[k] += -c.push * depth * n_x + across * n_y + noise * Normal(3, 1, k);
    s.fy[k] += -c.push * depth * n_y - across * n_x + noise * Normal(3, 2, k);
  }
}

double Turned(double a, double b) { return std::abs(std::remainder(a - b, 2 * kPi)); }

TEST(SideContact, FindsDirectionGapStiffnessAndFriction) {
  for (const double angle : {0.4, -1.9}) {
    SideContact truth;
    truth.angle = angle;
    truth.gap = 6e-6;
    truth.push = 5e5;
    truth.drag = 1e5;
    ForceSamples s = Motion();
    Push(s, truth, 0.05);
    const SideContact found = FindSideContact(s, 0.05);
    EXPECT_GT(found.share, 0.97);
    EXPECT_LT(Turned(found.angle, angle), 0.03);
    EXPECT_NEAR(found.gap, 6e-6, 6e-7);
    EXPECT_NEAR(found.push, 5e5, 2e4);
    EXPECT_NEAR(found.drag, 1e5, 1e4);
    EXPECT_EQ(found.period, 0);  // it is always there
    EXPECT_EQ(found.lobe, 0);
  }
}

// A constant force beside it (weight, a zero) changes nothing.
TEST(SideContact, AConstantForceIsNotPartOfIt) {
  SideContact truth;
  truth.angle = 1;
  truth.gap = 5e-6;
  truth.push = 4e5;
  ForceSamples plain = Motion(), shifted = Motion();
  Push(plain, truth, 0.05);
  Push(shifted, truth, 0.05);
  for (double& f : shifted.fx) f += 20;
  for (double& f : shifted.fy) f -= 7;
  const SideContact a = FindSideContact(plain, 0.05), b = FindSideContact(shifted, 0.05);
  EXPECT_LT(Turned(a.angle, b.angle), 1e-3);
  EXPECT_NEAR(a.gap, b.gap, 1e-7);
  EXPECT_NEAR(a.share, b.share, 1e-3);
}

// What pulls the rotor towards a side is no contact of that side; noise explains next to nothing.
TEST(SideContact, NoiseIsNoContact) {
  ForceSamples s = Motion();
  SideContact nothing;
  Push(s, nothing, 1);
  EXPECT_LT(FindSideContact(s, 0.05).share, 0.03);
}

TEST(SideContact, ABumpIsOnForItsShareOfThePeriod) {
  SideContact c;
  EXPECT_EQ(c.On(0.123), 1);  // a standing one always
  c.period = 0.2;
  c.phase = 0.25;
  c.duty = 0.4;
  EXPECT_DOUBLE_EQ(c.On(0.05), 1);                // its middle
  EXPECT_DOUBLE_EQ(c.On(0.25), 1);                // one period on
  EXPECT_NEAR(c.On(0.05 + 0.2 * 0.2), 0, 1e-12);  // its end, half of the duty later
  EXPECT_EQ(c.On(0.15), 0);
  double on = 0;
  for (int k = 0; k < 1000; ++k) on += c.On(0.2 * k / 1000) > 0 ? 1e-3 : 0;
  EXPECT_NEAR(on, 0.4, 3e-3);
}

// Friction has the sign of the sliding speed: rotation plus the motion across the contact.
TEST(SideContact, SlidingIsRotationAndMotion) {
  ForceSamples s = Motion(4);
  SideContact c;
  c.angle = kPi / 2;  // t points to -x there
  EXPECT_NEAR(c.Rubs(s, 0), 1, 1e-4);
  s.omega[1] *= -1;
  EXPECT_NEAR(c.Rubs(s, 1), -1, 1e-4);
  s.vx[2] = 2 * s.radius * s.omega[2];  // moves against the surface, faster than it
  EXPECT_NEAR(c.Rubs(s, 2), -1, 1e-4);
  s.omega[3] = 0;
  EXPECT_EQ(c.Rubs(s, 3), 0);
  s.vx[3] = -SideContact::kSlow;  // where the regularised friction is 1/√2
  EXPECT_NEAR(c.Rubs(s, 3), std::sqrt(0.5), 1e-12);
}

// A contact that comes and goes is found from the side that it pushes from, which is on no axis.
TEST(SideContact, AContactThatComesAndGoesIsFound) {
  SideContact truth;
  truth.angle = 0.8;
  truth.gap = 4e-6;
  truth.push = 5e5;
  truth.period = 0.055;
  truth.phase = 0.3;
  truth.duty = 0.4;
  ForceSamples s = Motion();
  Push(s, truth, 0.05);
  const SideContact found = FindSideContact(s, 0.05);
  EXPECT_GT(found.share, 0.9);
  EXPECT_NEAR(found.period, truth.period, 0.02 * truth.period);
  EXPECT_LT(Turned(found.angle, truth.angle), 0.08);
  EXPECT_NEAR(found.push, truth.push, 0.1 * truth.push);
}

}  // namespace
}  // namespace ambrig
