// The bending mode, and the contact effects that change moving parts.
#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "tests/effects/motion_rig.h"

namespace ambrig::motion {
namespace {

constexpr double kModeStep = 4e-5;

Plant Bending(double gain_a, double gain_b, double gyro = 0) {
  return PlantOf({{"bending-mode",
                   "rig",
                   {{"frequency", 330},
                    {"damping", 0.008},
                    {"gain_a", gain_a},
                    {"gain_b", gain_b},
                    {"gyro", gyro}}}});
}

TEST(MotionMode, FreeResponseHasItsFrequencyAndDamping) {
  Plant plant = Bending(0.4, 0.5);
  MotionState s;
  const double w = 2 * kPi * 330, damped = w * std::sqrt(1 - 0.008 * 0.008);
  s.q[5] = 1e-5;
  s.v[5] = -0.008 * w * 1e-5;  // so that eta = 1e-5 exp(-zeta w t) cos(w_d t)
  for (int n = 0; n < 2500; ++n) plant.rotor.Step(s, DofVector{}, 0, 0, kModeStep);
  const double envelope = 1e-5 * std::exp(-0.008 * w * s.t);
  // RK4 at w h = 0.083: phase error (w h)^5/120 per step = 3e-8, over 2500 steps 1e-4.
  EXPECT_NEAR(s.q[5], envelope * std::cos(damped * s.t), 5e-4 * envelope);
  EXPECT_EQ(s.q[0], 0) << "a free mode does not move the rigid body";
}

TEST(MotionMode, GainsAreThoseOfThePlanes) {
  Plant plant = Bending(0.4, -0.7);
  for (const auto& [bearing, gain] : {std::pair{0, 0.4}, std::pair{1, -0.7}}) {
    MotionState s;
    s.q[5] = 1;
    // 400 straight pieces of the shape: off by 2e-4 of the end values of its modes, which are 1 to
    // 3 here.
    EXPECT_NEAR(plant.bearings[static_cast<std::size_t>(bearing)].plane.X(s.q), gain, 1e-3);
  }
}

TEST(MotionMode, ShapeIsOrthogonalToTheRigidModes) {
  // On the uniform beam of the rotor's mass and inertia: ∫ gain dz = ∫ z gain dz = 0 for any gains.
  const double length = std::sqrt(12 * 0.036 / 4.2);
  for (const auto& [a, b] : {std::pair{0.5, 0.5}, std::pair{0.3, -0.6}}) {
    Plant plant = Bending(a, b);
    const BendingMode& mode = plant.rotor.modes().back();
    double sum = 0, first = 0, square = 0;
    constexpr int kParts = 2000;
    for (int k = 0; k < kParts; ++k) {
      const double u = (k + 0.5) / kParts - 0.5, g = mode.Gain(u * length);
      sum += g / kParts;
      first += u * g / kParts;
      square += g * g / kParts;
    }
    EXPECT_NEAR(sum, 0, 5e-4 * std::sqrt(square));
    EXPECT_NEAR(first, 0, 5e-4 * std::sqrt(square));
  }
}

TEST(MotionMode, GainsOfTheUniformBeamGiveItsFirstMode) {
  // The free uniform beam: gain(z) = 2 phi_1(z/L)/√m; 0.4198, 0.6333 are phi_1 at ∓0.12, ∓0.135 m
  // of L = 0.3207 m. Blending in the third mode costs (10.996/4.730)^8 = 855: below a percent of
  // the end.
  Plant plant = Bending(2 * 0.4198316 / std::sqrt(4.2), 2 * 0.4198316 / std::sqrt(4.2));
  EXPECT_NEAR(plant.rotor.modes().back().Gain(0.135), 2 * 0.6333250 / std::sqrt(4.2), 0.01);
  EXPECT_NEAR(plant.rotor.modes().back().Gain(-0.135), 2 * 0.6333250 / std::sqrt(4.2), 0.01);
}

// A shaft that bends as a rod of 1.1 times the length has the first mode of that rod: the gain at a
// sensor beside the magnet is another one, the gains at the magnets stay.
TEST(MotionMode, LengthStretchesTheShape) {
  const double length = std::sqrt(12 * 0.036 / 4.2);
  const auto gain = [](const Plant& plant, double z) { return plant.rotor.modes().back().Gain(z); };
  const auto bent = [](double stretch) {
    return PlantOf({{"bending-mode",
                     "rig",
                     {{"frequency", 330}, {"gain_a", 0.5}, {"gain_b", 0.5}, {"length", stretch}}}});
  };
  const Plant rod = bent(1), longer = bent(1.1);
  for (const double z : {-0.12, 0.12}) EXPECT_NEAR(gain(longer, z), gain(rod, z), 2e-3);
  EXPECT_GT(std::abs(gain(longer, 0.135) - gain(rod, 0.135)), 5e-3);
  double sum = 0, square = 0;
  constexpr int kParts = 2000;
  for (int k = 0; k < kParts; ++k) {
    const double g = gain(longer, 1.1 * length * ((k + 0.5) / kParts - 0.5));
    sum += g / kParts;
    square += g * g / kParts;
  }
  EXPECT_NEAR(sum, 0, 5e-4 * std::sqrt(square)) << "no rigid motion of the rod of that length";
}

TEST(MotionMode, BearingOnANodeDoesNotMakeAWildShape) {
  // +-0.12 m lies 6 mm beside the odd mode's nodes: its gains alone would ask for 1/0.043 of it.
  Plant plant = Bending(-0.3, 0.3);
  EXPECT_LT(std::abs(plant.rotor.modes().back().Gain(0.135)), 1.5);
}

TEST(MotionMode, GyroSplitsTheModeEvenly) {
  // eta = r exp(i w t):  w0² - w² - g Omega w = 0 up to the sign of the whirl.
  Plant plant = PlantOf(
      {{"bending-mode",
        "rig",
        {{"frequency", 330}, {"damping", 0}, {"gain_a", 0.4}, {"gain_b", 0.4}, {"gyro", 0.1}}}});
  const double w0 = 2 * kPi * 330, g = 0.1 * 800;
  for (const double sign : {1.0, -1.0}) {
    const double w = sign * g / 2 + std::sqrt(g * g / 4 + w0 * w0);
    MotionState s;
    s.Omega = 800;
    s.q[5] = 1e-5;
    s.v[6] = sign * w * 1e-5;  // forward or backward circle
    const DofVector a = Accelerations(plant, s);
    EXPECT_NEAR(a[5], -w * w * 1e-5, 1e-10 * w * w);
  }
}

TEST(MotionContact, FrictionIsItselfOrAFractionOfTheRigs) {
  EXPECT_EQ(PlantOf({{"contact-friction", "A", {{"friction", 0.3}}}})
                .rotor.auxiliaries()[0]
                .parameters.friction,
            0.3);
  EXPECT_EQ(PlantOf({{"contact-friction", "B", {{"friction", 0.0}}}})
                .rotor.auxiliaries()[1]
                .parameters.friction,
            0.0);
  EXPECT_EQ(PlantOf({{"contact-friction", "A", {{"friction", -0.5}}}})
                .rotor.auxiliaries()[0]
                .parameters.friction,
            0.075);
  EXPECT_EQ(PlantOf({{"contact-friction", "A", {{"friction", -1.0}}}})
                .rotor.auxiliaries()[0]
                .parameters.friction,
            0.15);
}

TEST(MotionContact, FrictionNeedsAnAuxiliaryBearing) {
  RigParameters rig = RigWith({{"contact-friction", "A", {{"friction", 0.3}}}});
  rig.bearings[0].auxiliary.reset();
  try {
    BuildPlant(TrueRig(rig));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("needs an auxiliary bearing"), std::string::npos)
        << e.what();
  }
}

TEST(MotionContact, RotorRestsLowerOnAMount) {
  RigParameters rig =
      RigWith({{"contact-mount", "A", {{"stiffness", 5e6}, {"damping", 500}, {"mass", 0.2}}}});
  rig.gravity = {0, -9.81, 0};
  const Plant plant = BuildPlant(TrueRig(rig));
  RigParameters base = Rig();
  base.gravity = rig.gravity;
  const Plant rigid = BuildPlant(TrueRig(base));
  MotionState soft, hard;
  plant.rotor.Rest(soft);
  rigid.rotor.Rest(hard);
  const double load = 4.2 * 9.81 / 2;
  const PlaneMap& a = plant.bearings[0].plane;
  EXPECT_NEAR(a.Y(soft.q), a.Y(hard.q) - load / 5e6, 1e-15);
  for (const double acceleration : Accelerations(plant, soft)) EXPECT_NEAR(acceleration, 0, 1e-9);
}

TEST(MotionContact, IdleMountRingsDownHoweverStiff) {
  for (const double stiffness : {1e6, 1e9, 9e11}) {
    Plant plant = PlantOf(
        {{"contact-mount", "A", {{"stiffness", stiffness}, {"damping", 20}, {"mass", 0.1}}}});
    MotionState s;
    const std::size_t d = static_cast<std::size_t>(plant.rotor.auxiliaries()[0].mount_dof);
    s.q[d] = 1e-9;
    for (int n = 0; n < 2500; ++n) plant.rotor.Step(s, DofVector{}, 0, 0, kModeStep);
    // exp(-c t/2m) = exp(-10) at least (RK4 takes some energy too); nothing may grow.
    EXPECT_LT(std::abs(s.q[d]), 1e-9 * std::exp(-9.9)) << stiffness;
  }
}

}  // namespace
}  // namespace ambrig::motion
