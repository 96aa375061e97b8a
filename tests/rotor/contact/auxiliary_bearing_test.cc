/// The contact law by itself, and the rotor of the fast engine in it: friction, restitution, free
/// fall.
#include "rotor/contact/auxiliary_bearing.h"

#include <gtest/gtest.h>

#include "core/math/constants.h"
#include "rotor/motion/rotor_model.h"

namespace ambrig {
namespace {

// Auxiliary bearing of examples/reference/rig.toml.
constexpr AuxiliaryParameters kReference = {2e-4, 2e7, 1.0, 0.5, 0.15};
constexpr double kJournal = 0.03;

TEST(AuxiliaryBearing, NothingInsideTheClearance) {
  const ContactForce c = RadialContact(kReference, kJournal, 1.9e-4, 0, 5, 0, 100, 0);
  EXPECT_LT(c.penetration, 0);
  EXPECT_EQ(c.fx, 0);
  EXPECT_EQ(c.fy, 0);
  EXPECT_EQ(c.torque, 0);
}

// N = k pⁿ (1 + h p'), towards the centre whatever the direction; never below zero.
TEST(AuxiliaryBearing, NormalForce) {
  AuxiliaryParameters p = kReference;
  p.friction = 0;
  for (double n : {1.0, 1.5}) {
    p.exponent = n;
    for (double angle : {0.3, 2.0, 4.5}) {
      const double r = 2e-4 + 3e-6, v = 0.2;
      const ContactForce c = RadialContact(p, kJournal, r * std::cos(angle), r * std::sin(angle),
                                           v * std::cos(angle), v * std::sin(angle), 0, 0);
      const double N = 2e7 * std::pow(3e-6, n) * (1 + 0.5 * v);
      EXPECT_NEAR(c.fx, -N * std::cos(angle), 1e-9 * N);
      EXPECT_NEAR(c.fy, -N * std::sin(angle), 1e-9 * N);
    }
  }
  // 1 + h p' < 0: it does not pull
  EXPECT_EQ(RadialContact(p, kJournal, 2.1e-4, 0, -3, 0, 0, 0).normal, 0);
}

// mu N v/√(v² + v_s²) against the sliding of the surface; its torque brakes the spin and drives the
// race.
TEST(AuxiliaryBearing, Friction) {
  const double Omega = 157, r = 2.05e-4, vt = 0.03;
  const ContactForce c = RadialContact(kReference, kJournal, 0, -r, vt, 0, Omega, 20);
  // at the bottom the tangent is +x
  const double N = 2e7 * 5e-6, slide = vt + (Omega - 20) * kJournal;
  const double friction = 0.15 * N * slide / std::hypot(slide, kSlidingSpeed);
  EXPECT_NEAR(c.fy, N, 1e-9 * N);
  EXPECT_NEAR(c.fx, -friction, 1e-9 * N);
  EXPECT_NEAR(c.torque, -friction * kJournal, 1e-9 * N);
  EXPECT_EQ(c.race_torque, -c.torque);
  EXPECT_EQ(RadialContact(kReference, kJournal, 0, -r, 0, 0, 0, 0).fx, 0);  // rolling: none
}

TEST(AuxiliaryBearing, AxialStopsOnBothSides) {
  AuxiliaryParameters p = kReference;
  p.clearance = 2.5e-4;
  EXPECT_EQ(AxialContact(p, 2.4e-4, 1), 0);
  EXPECT_NEAR(AxialContact(p, 2.6e-4, 0.1), -2e7 * 1e-5 * 1.05, 1e-9);
  EXPECT_NEAR(AxialContact(p, -2.6e-4, -0.1), 2e7 * 1e-5 * 1.05, 1e-9);
  EXPECT_NEAR(2e7 * std::pow(StaticPenetration(p, 20), p.exponent), 20, 1e-9);
}

/// The reference rotor alone, symmetric, in two bearings without friction.
RotorModel Loose(const AuxiliaryParameters& p, double g) {
  RotorModel m({4.2, 0.036, 0.0042, kJournal}, {0, -g, 0});
  m.AddAuxiliary("A", -0.1, p);
  m.AddAuxiliary("B", 0.1, p);
  return m;
}

/// e of Hunt and Crossley on a free mass: a - ln(1 + a) = -a e - ln(1 - a e), a = h v.
double RestitutionOf(double a) {
  double lo = 0, hi = std::min(1.0, 1 / a * (1 - 1e-12));
  const double left = a - std::log1p(a);
  for (int k = 0; k < 100; ++k) {
    const double e = 0.5 * (lo + hi);
    (-a * e - std::log1p(-a * e) < left ? lo : hi) = e;
  }
  return 0.5 * (lo + hi);
}

// The engine's own steps (40 us, divided in contact) through an impact; exact e for any exponent.
TEST(RotorInContact, Restitution) {
  for (double exponent : {1.0, 1.5})
    for (double nominal : {0.9, 0.76, 0.5}) {
      const double v = 0.1, a = 1.5 * (1 - nominal);
      AuxiliaryParameters p = {2e-4, exponent == 1 ? 2e7 : 2.4614e8, exponent, a / v, 0};
      const RotorModel m = Loose(p, 0);
      MotionState s;
      s.v[1] = -v;
      for (int n = 0; n < 160; ++n) m.Step(s, {}, 0, 0, 40e-6);
      EXPECT_NEAR(s.v[1] / v, RestitutionOf(a), 1e-4) << exponent << " " << nominal;
      EXPECT_NEAR(s.v[3], 0, 1e-12);  // both bearings at once: no tilt
    }
}

// Without damping a contact gives back what it took.
TEST(RotorInContact, ElasticBounceKeepsItsEnergy) {
  const RotorModel m = Loose({2e-4, 2e7, 1.5, 0, 0}, 9.81);
  MotionState s;
  s.v[3] = 0.2;  // tilting: the bearings are hit one after the other
  const double before = m.Energy(s);
  int contacts = 0;
  for (int n = 0; n < 2500; ++n) {
    m.Step(s, {}, 0, 0, 40e-6);
    contacts += m.Penetration(s, 0) > 0 || m.Penetration(s, 1) > 0;
  }
  EXPECT_GT(contacts, 10);
  EXPECT_NEAR(m.Energy(s), before, 2e-4 * std::abs(before));
}

// y = c after √(2c/g): RK4 is exact for a parabola. 6.386 ms through 0.2 mm.
TEST(RotorInContact, FreeFallReachesTheBearingInTime) {
  const RotorModel m = Loose(kReference, 9.81);
  MotionState s;
  const double fall = std::sqrt(2 * 2e-4 / 9.81);
  while (s.t + 40e-6 < fall) {
    m.Step(s, {}, 0, 0, 40e-6);
    EXPECT_NEAR(s.q[1], -0.5 * 9.81 * s.t * s.t, 1e-16);
    EXPECT_LT(m.Penetration(s, 0), 0);
  }
  m.Step(s, {}, 0, 0, 40e-6);
  EXPECT_GT(m.Penetration(s, 0), 0);
  EXPECT_NEAR(fall, 6.386e-3, 5e-7);
}

// Sliding friction of a rotor lying in its bearings at speed: mu m g R, without rolling away at
// first.
TEST(RotorInContact, FrictionSpinsDownAtTheExactRate) {
  RotorModel m = Loose(kReference, 9.81);
  m.SetSpeed(SpeedProfile(std::vector<std::vector<double>>{{0.0, 1000.0}}), 0);
  MotionState s;
  m.Rest(s);
  s.Omega = 1000;
  double torque = 0;
  DofVector a{};
  m.Accelerations(s, {}, 0, 0, a, &torque);
  EXPECT_NEAR(torque, -0.15 * 4.2 * 9.81 * kJournal, 1e-6);
  EXPECT_NEAR(a[1], 0, 1e-6);  // at rest on static penetration
}

}  // namespace
}  // namespace ambrig
