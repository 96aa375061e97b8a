/// The rotor on the Open Dynamics Engine against closed forms: free fall, restitution, friction,
/// gyroscopic precession; mounts, races, base, stops against the model they stand for.
#include "rotor/crosscheck/ode_rotor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "tests/rotor/restitution.h"

namespace ambrig {
namespace {

constexpr double kPeriod = 4e-5;  // [s] between two calls of Step, the reference rig's
constexpr double kGravity = 9.81;

RotorParameters Reference() { return {4.2, 0.036, 0.0042, 0.030}; }

/// Two equal auxiliary bearings of the reference rig at ±z: no tilt from a fall.
RotorModel Dropping(double friction, double damping = 0.5, double omega = 0,
                    double gravity = kGravity) {
  RotorModel model(Reference(), {0, -gravity, 0});
  AuxiliaryParameters p;
  p.clearance = 2e-4;
  p.stiffness = 2e7;
  p.damping = damping;
  p.friction = friction;
  model.AddAuxiliary("A", -0.12, p);
  model.AddAuxiliary("B", 0.12, p);
  model.SetSpeed(SpeedProfile(std::vector<std::vector<double>>{{0.0, omega}}));
  return model;
}

void Advance(RotorStepper& rotor, MotionState& s, double until) {
  while (s.t < until - 1e-12) rotor.Step(s, DofVector{}, 0, 0, kPeriod);
}

TEST(OdeRotor, FallsFreely) {
  const RotorModel model = Dropping(0.15);
  OdeRotor rotor(model, {1e-6, 1e-6, false});
  MotionState s;
  Advance(rotor, s, 6e-3);
  // Semi-implicit Euler under a constant force, exactly: y = -g h² n (n + 1)/2, v = -g h n.
  const double n = 6000, h = 1e-6;
  EXPECT_NEAR(s.q[1], -kGravity * h * h * n * (n + 1) / 2, 1e-15);
  EXPECT_NEAR(s.v[1], -kGravity * 6e-3, 1e-13);
  EXPECT_EQ(s.q[0], 0);
  EXPECT_EQ(s.q[3], 0) << "a fall does not tilt";
}

/// Rebound speed over impact speed, in free space: 1 um before the race at speed v.
double Rebound(const OdeOptions& options, double damping, double v, double exponent = 1) {
  RotorModel model = Dropping(0, damping, 0, 0);
  for (AuxiliaryPlane& plane : model.auxiliaries()) {
    plane.parameters.exponent = exponent;
    if (exponent > 1) plane.parameters.stiffness = 5e9;  // about the same depth, 17 um
  }
  OdeRotor rotor(model, options);
  MotionState s;
  s.q[1] = -1.99e-4;
  s.v[1] = -v;
  Advance(rotor, s, 4e-3);
  return s.v[1] / v;
}

TEST(OdeRotor, ReboundsWithTheRestitutionOfTheLaw) {
  // Two damping factors: the reference rig's, and one that halves the speed.
  for (const double damping : {0.5, 20.0}) {
    const double wanted = Restitution(damping, 0.06);
    const double error = Rebound({}, damping, 0.06) - wanted;
    const double coarser = Rebound({4e-6, 4e-6, false}, damping, 0.06) - wanted;
    // 880 steps an impact, symplectic: what is left is of order (ω h)² = 1e-5.
    EXPECT_NEAR(error, 0, 1e-5) << damping;
    EXPECT_NEAR(coarser, 0, 1e-4) << damping;
    // The same for every exponent n.
    const double hertz = Rebound({}, damping, 0.06, 1.5) - wanted;
    EXPECT_NEAR(hertz, 0, 1e-5) << damping;
    std::printf("[restitution] n = 1.5: error %.1e\n", hertz);
    std::printf("[restitution] damping %g s/m: law %.5f, error %.1e (step 4 us: %.1e)\n", damping,
                wanted, error, coarser);
  }
}

TEST(Restitution, HasTheKnownValues) {
  // published_values.md 5: Hunt and Crossley's factor 1.5 (1 - e)/v gives other than nominal e.
  EXPECT_NEAR(Restitution(1.5 * 0.1 / 0.06, 0.06), 0.90902, 5e-6);
  EXPECT_NEAR(Restitution(1.5 * 0.24 / 0.06, 0.06), 0.80573, 5e-6);
  EXPECT_NEAR(Restitution(1.5 * 0.5 / 0.06, 0.06), 0.66296, 5e-6);
  EXPECT_NEAR(Restitution(8 * 0.5 / (5 * 0.5), 1.0), 0.47044, 5e-6);
  EXPECT_EQ(Restitution(0, 1), 1);
  EXPECT_NEAR(Restitution(1e-4, 0.999), Restitution(1e-4, 1.001), 2e-7) << "the two formulas meet";
}

TEST(OdeRotor, FrictionPushesAgainstTheSurfaceAndIsMuTimesTheLoad) {
  // Held down on both bearings, turning fast: friction mu N at the bottom, surface moving +x for
  // Omega > 0 (v = Omega × (0, -R) = (Omega R, 0)), hence a push to -x: the way of backward whirl.
  for (const double omega : {157.0, -157.0, 1257.0}) {
    RotorModel model = Dropping(0.15, 0.5, omega);
    OdeRotor rotor(model);
    MotionState s;
    model.Rest(s);
    rotor.Step(s, DofVector{}, 0, 0, kPeriod);
    const double expected = -std::copysign(0.15 * kGravity * kPeriod, omega);
    // In one period the journal climbs 1e-5 of the circle; the load stays as it is.
    EXPECT_NEAR(s.v[0], expected, 1e-3 * std::abs(expected)) << omega;
  }
}

TEST(OdeRotor, FrictionCarriesTheRotorUpTheBackwardSide) {
  // Held in contact by heavy damping, it settles where the slope is the friction angle atan(mu).
  RotorModel model = Dropping(0.15, 50, 1257.0);
  OdeRotor rotor(model);
  MotionState s;
  model.Rest(s);
  double sum = 0, count = 0, least = 0;
  while (s.t < 0.6) {
    rotor.Step(s, DofVector{}, 0, 0, kPeriod);
    least = std::min(least, s.q[0]);
    if (s.t < 0.2) continue;
    sum += std::atan2(s.q[0], -s.q[1]);
    count += 1;
  }
  EXPECT_LT(least, -2e-5);
  // A pendulum about -atan(mu) in the circle c: its mean is the angle, up to amplitude² / 16.
  EXPECT_NEAR(sum / count, -std::atan(0.15), 0.01);
}

TEST(OdeRotor, SticksAtRest) {
  RotorModel model = Dropping(0.15);
  OdeRotor rotor(model);
  MotionState s;
  model.Rest(s);
  // On the side of the circle, below the friction angle: it stays (the regularised law creeps).
  const double angle = 0.1, r = std::hypot(s.q[0], s.q[1]);
  s.q[0] = r * std::sin(angle);
  s.q[1] = -r * std::cos(angle);
  const double before = s.q[0];
  Advance(rotor, s, 0.05);
  EXPECT_NEAR(s.q[0], before, 2e-8);
}

/// Moving parts of every kind, thrown off centre, without the chaos of many impacts: ODE's bodies
/// in the frame of the floor against the model's relative coordinates.
class MovingParts : public ::testing::TestWithParam<int> {};

constexpr int kMounts = 1, kRaces = 2, kBase = 4;

TEST_P(MovingParts, GoTheWayOfTheModel) {
  RotorModel model(Reference(), {0, -kGravity, 0});
  AuxiliaryParameters p;
  p.clearance = 2e-4;
  p.stiffness = 2e7;
  p.damping = 0.5;
  p.friction = 0.15;
  if (GetParam() & kMounts) {
    p.mount_stiffness = 5e6;
    p.mount_damping = 500;
    p.mount_mass = 0.2;
  }
  if (GetParam() & kRaces) {
    p.race_inertia = 2e-5;
    p.race_drag = 1e-4;
  }
  model.AddAuxiliary("A", -0.12, p);
  model.AddAuxiliary("B", 0.13, p);
  model.axial_free = true;
  p.clearance = 1e-5;
  model.SetAxialStop(p);
  if (GetParam() & kBase) model.SetBase({20, {2.84e6, 4.55e6}, {300, 240}});  // 60 and 76 Hz
  model.AddLoad(-0.05, 20, 0, 15, 1e-3, 3e-3);
  model.SetSpeed(SpeedProfile(std::vector<std::vector<double>>{{0.0, 600.0}}), 4e-3);

  OdeRotor rotor(model, {2.5e-7, 1e-6, false});
  MotionState ode, mine;
  ode.Omega = mine.Omega = 600;
  double largest = 0, turned = 0, difference = 0;
  while (mine.t < 12e-3) {
    model.Step(mine, DofVector{}, 30, 10, kPeriod);
    rotor.Step(ode, DofVector{}, 30, 10, kPeriod);
    for (int d = 0; d < model.dof(); ++d) {
      const auto k = static_cast<std::size_t>(d);
      const bool race =
          d >= 5 && model.auxiliaries()[0].race_dof >= 0 &&
          (d == model.auxiliaries()[0].race_dof || d == model.auxiliaries()[1].race_dof);
      if (race) continue;
      largest = std::max(largest, std::abs(mine.q[k]));
      difference = std::max(difference, std::abs(mine.q[k] - ode.q[k]));
    }
    turned = std::max(turned, model.Penetration(mine, 0));
  }
  ASSERT_GT(turned, 5e-6) << "the rotor has touched";
  ASSERT_GT(model.AxialPenetration(mine), -1e-3);
  // First order in the step (ω h = 1e-3) after one or two impacts of 0.06 m/s.
  EXPECT_LT(difference, 1e-3 * largest);
  EXPECT_NEAR(ode.Omega, mine.Omega, 1e-3 * (600 - mine.Omega) + 1e-9);
  EXPECT_LT(mine.Omega, 600) << "friction has taken speed";
  if (GetParam() & kRaces) {
    for (const AuxiliaryPlane& plane : model.auxiliaries()) {
      const auto d = static_cast<std::size_t>(plane.race_dof);
      // The race's surface is at journal radius + clearance here, at the journal radius there.
      EXPECT_NEAR(ode.v[d], mine.v[d], 2e-2 * std::abs(mine.v[d])) << plane.name;
      EXPECT_GT(mine.v[d], 1);
    }
  }
  std::printf("[parts %d] largest %.1f um, difference %.3f um, Omega %.4f %.4f\n", GetParam(),
              largest * 1e6, difference * 1e6, mine.Omega, ode.Omega);
}

INSTANTIATE_TEST_SUITE_P(OdeRotor, MovingParts,
                         ::testing::Values(0, kMounts, kRaces, kMounts | kRaces, kBase,
                                           kBase | kRaces, kBase | kMounts,
                                           kBase | kMounts | kRaces));

/// Torque-free: the rates turn at Ip Omega/It; returns the error of their angle and of their size.
std::pair<double, double> Precession(double omega, const OdeOptions& options) {
  RotorModel model(Reference(), {0, 0, 0});
  model.SetSpeed(SpeedProfile(std::vector<std::vector<double>>{{0.0, omega}}));
  OdeRotor rotor(model, options);
  MotionState s;
  s.v[3] = 1e-3;
  Advance(rotor, s, 0.3);
  const double wanted = 0.0042 / 0.036 * omega * s.t;
  return {std::remainder(std::atan2(s.v[4], s.v[3]) - wanted, 2 * kPi),
          std::hypot(s.v[3], s.v[4]) / 1e-3 - 1};
}

TEST(OdeRotor, PrecessesAtTheClosedForm) {
  // It w' = i Ip Omega w: angle Ip Omega t/It (44 rad at 12 000 rpm), size unchanged.
  for (const double omega : {157.08, 1256.64, 6283.19}) {
    const auto [angle, size] = Precession(omega, {});
    const auto [finer, size2] = Precession(omega, {5e-7, 2.5e-6, false});
    const double h = 5e-6, turns = omega * h;
    // Midpoint rule: phase error of order (Omega h)² per radian.
    EXPECT_LT(std::abs(angle), turns * turns * 0.117 * omega * 0.3) << omega;
    EXPECT_NEAR(size, 0, turns * turns) << omega;
    if (omega > 1000) {
      EXPECT_NEAR(angle / finer, 4, 0.5) << "second order, " << omega;
    }
    std::printf("[ours]   %7.0f rad/s: angle %.2e rad, size %.2e (half step %.2e, %.2e)\n", omega,
                angle, size, finer, size2);
    const auto [native, native_size] = Precession(omega, {1e-6, 5e-6, true});
    std::printf("[native] %7.0f rad/s: angle %.2e rad, size %.2e\n", omega, native, native_size);
    EXPECT_GT(native_size, 0.01) << "ODE's own term is good enough by now: use it";
  }
}

}  // namespace
}  // namespace ambrig
