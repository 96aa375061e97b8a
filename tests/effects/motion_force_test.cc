// Force and base effects against closed forms, power balances and differences.
#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "tests/effects/motion_rig.h"

namespace ambrig::motion {
namespace {

constexpr double kMass = 4.2, kPolar = 0.0042, kForceStep = 4e-5;

/// Forward circular whirl of the whole rotor: radius r, frequency w, at phase 0.7.
MotionState Whirl(double r, double w, double Omega) {
  MotionState s;
  s.Omega = Omega;
  const double a = 0.7;
  s.q[0] = r * std::cos(a);
  s.q[1] = r * std::sin(a);
  s.v[0] = -w * s.q[1];
  s.v[1] = w * s.q[0];
  return s;
}

double Power(const RotorForces& f, const MotionState& s) {
  double p = 0;
  for (std::size_t d = 0; d < kMaxDof; ++d) p += f.Q[d] * s.v[d];
  return p;
}

TEST(MotionForce, UnbalanceIsMinusTheAccelerationOfTheOffsetMass) {
  Plant plant = PlantOf({{"unbalance", "A", {{"c", 3e-5}, {"s", -1e-5}}}});
  const double w0 = 120, a = 400, t = 0.3, h = 1e-4;  // theta = w0 t + a t²/2
  const auto place = [&](double time, bool y) {
    const double theta = w0 * time + a * time * time / 2;
    return y ? 3e-5 * std::sin(theta) - 1e-5 * std::cos(theta)
             : 3e-5 * std::cos(theta) + 1e-5 * std::sin(theta);
  };
  MotionState s;
  s.theta = w0 * t + a * t * t / 2;
  s.Omega = w0 + a * t;
  s.Omega_dot = a;
  const RotorForces f = Forces(plant, s);
  for (const bool y : {false, true}) {
    const double exact = -(place(t + h, y) - 2 * place(t, y) + place(t - h, y)) / (h * h);
    // Central difference: relative error (Omega h)²/12 = 5e-5.
    EXPECT_NEAR(f.Q[y ? 1 : 0], exact, 1e-4 * 3.2e-5 * s.Omega * s.Omega);
  }
  EXPECT_NEAR(f.Q[4], -0.12 * f.Q[0], 1e-15);
  EXPECT_EQ(f.stator_x, 0);
}

TEST(MotionForce, FreeRotorTurnsAboutItsMassAxis) {
  Plant plant = PlantOf(
      {{"unbalance", "A", {{"c", 1e-5}, {"s", 0}}}, {"unbalance", "B", {{"c", 1e-5}, {"s", 0}}}});
  const double w = 500, r = -2e-5 / kMass;  // x = -u/m cos(w t): the mass centre stays put
  plant.rotor.SetSpeed(SpeedProfile({{0, w}, {1, w}}));
  MotionState s;
  s.q[0] = r;
  s.v[1] = w * r;
  plant.rotor.SetSpin(s);
  for (int n = 0; n < 2500; ++n) plant.rotor.Step(s, DofVector{}, 0, 0, kForceStep);
  // RK4 at w h = 0.02: local error (w h)^5/120 per step, 2500 steps, grows linearly in a free body:
  // < 1e-5.
  EXPECT_NEAR(s.q[0], r * std::cos(w * s.t), 1e-5 * std::abs(r));
  EXPECT_NEAR(s.q[1], r * std::sin(w * s.t), 1e-5 * std::abs(r));
}

TEST(MotionForce, CrossCouplingFeedsTheForwardWhirl) {
  Plant plant = PlantOf({{"cross-coupling", "A", {{"stiffness", 4e4}}}});
  const MotionState s = Whirl(1e-5, 300, 0), back = Whirl(1e-5, -300, 0);
  EXPECT_NEAR(Power(Forces(plant, s), s), 4e4 * 300 * 1e-10, 1e-15);  // k w r²
  EXPECT_NEAR(Power(Forces(plant, back), back), -4e4 * 300 * 1e-10, 1e-15);
  EXPECT_EQ(Forces(plant, s).stator_x, Forces(plant, s).Q[0]);
}

/// Spring and damper on the centre of mass.
class Support : public ForceTerm {
 public:
  void Add(const MotionState& s, RotorForces& f) const override {
    for (const std::size_t d : {0u, 1u}) f.Q[d] -= kStiffness * s.q[d] + kDamping * s.v[d];
  }
  static constexpr double kStiffness = kMass * 400 * 400, kDamping = 50;
};

double GrowthOverOneSecond(double cross) {
  Plant plant = PlantOf({{"cross-coupling", "A", {{"stiffness", cross / 2}}},
                         {"cross-coupling", "B", {{"stiffness", cross / 2}}}});
  plant.rotor.terms.push_back(std::make_unique<Support>());
  MotionState s = Whirl(1e-7, 400, 0);
  for (int n = 0; n < 25000; ++n) plant.rotor.Step(s, DofVector{}, 0, 0, kForceStep);
  return std::log(std::hypot(s.q[0], s.q[1]) / 1e-7);
}

TEST(MotionForce, WhirlTurnsUnstableWhereCrossCouplingBeatsDamping) {
  // Growth rate (k/w - c)/2m: 1 % on either side of k = c w.
  const double threshold = Support::kDamping * 400;
  for (const double factor : {0.9, 1.1})
    EXPECT_NEAR(GrowthOverOneSecond(factor * threshold),
                (factor - 1) * Support::kDamping / (2 * kMass), 0.02);
}

TEST(MotionForce, RotatingDampingChangesSignAtTheWhirlFrequency) {
  Plant plant = PlantOf({{"rotating-damping", "rig", {{"damping", 80}}}});
  for (const double Omega : {0.0, 200.0, 300.0, 500.0}) {
    const MotionState s = Whirl(1e-5, 300, Omega);
    EXPECT_NEAR(Power(Forces(plant, s), s), -80 * (300 - Omega) * 300 * 1e-10, 1e-15);
  }
}

TEST(MotionForce, RotatingDampingOfAFlexibleShaftLeavesRigidMotionAlone) {
  Plant plant = PlantOf({{"bending-mode", "rig", {{"gain_a", 0.3}, {"gain_b", 0.4}}},
                         {"rotating-damping", "rig", {{"damping", 80}}}});
  const MotionState rigid = Whirl(1e-5, 300, 900);
  for (const double q : Forces(plant, rigid).Q) EXPECT_EQ(q, 0);
  MotionState bent;
  bent.v[5] = 1e-3;
  const RotorForces f = Forces(plant, bent);
  EXPECT_NEAR(f.Q[5], -40 * (0.09 + 0.16) * 1e-3, 1e-3 * 0.01);  // gains to 2e-4
  EXPECT_EQ(f.Q[0], 0);
}

TEST(MotionForce, SidePullAlongTheDisplacement) {
  Plant plant =
      PlantOf({{"side-pull", "B", {{"stiffness", 2e5}}}, {"side-pull", "z", {{"stiffness", 1e5}}}});
  MotionState s;
  s.q[0] = 1e-5;
  s.q[1] = -2e-5;
  s.q[2] = 3e-5;
  const RotorForces f = Forces(plant, s);
  EXPECT_NEAR(f.Q[0], 2, 1e-12);
  EXPECT_NEAR(f.Q[1], -4, 1e-12);
  EXPECT_NEAR(f.Q[2], 3, 1e-12);
  EXPECT_NEAR(f.stator_x, 2, 1e-12);
  EXPECT_NEAR(f.stator_y, -4, 1e-12);
}

TEST(MotionForce, CouplingPushesTwicePerTurn) {
  Plant plant = PlantOf({{"coupling-misalignment", "B", {{"c", 3}, {"s", 4}}}});
  MotionState s;
  EXPECT_NEAR(Forces(plant, s).Q[0], 3, 1e-12);
  EXPECT_NEAR(Forces(plant, s).Q[1], 4, 1e-12);
  s.theta = kPi / 4;  // a right angle of the force
  s.Omega = 1000;
  EXPECT_NEAR(Forces(plant, s).Q[0], -4, 1e-12);
  EXPECT_NEAR(Forces(plant, s).Q[1], 3, 1e-12);
}

TEST(MotionForce, ConstantLoadAcceleratesTheRotor) {
  Plant plant = PlantOf({{"constant-load", "A", {{"fx", 4.2}, {"fy", -8.4}}}});
  const DofVector a = Accelerations(plant, MotionState{});
  EXPECT_NEAR(a[0], 1, 1e-12);
  EXPECT_NEAR(a[1], -2, 1e-12);
  EXPECT_NEAR(a[4], -0.12 * 4.2 / 0.036, 1e-12);
}

TEST(MotionForce, WindageSlowsAFreeRotorAlongAHyperbola) {
  const double drag = 1e-6, w0 = 1000;
  Plant plant = PlantOf({{"windage", "rig", {{"drag", drag}}}});
  plant.rotor.SetSpeed(SpeedProfile({{0, w0}, {1, w0}}), 0);
  MotionState s;
  s.Omega = w0;
  for (int n = 0; n < 25000; ++n) plant.rotor.Step(s, DofVector{}, 0, 0, kForceStep);
  EXPECT_NEAR(s.Omega, w0 / (1 + drag * w0 * s.t / kPolar), 1e-9 * w0);
}

TEST(MotionForce, BowRunsOppositeAtTheEndsAtAnySpeed) {
  Plant plant = PlantOf({{"shaft-bow", "rig", {{"c", 1e-5}, {"s", 2e-6}}}});
  MotionState s;
  for (const double theta : {0.0, 1.2, 4.0}) {
    s.theta = theta;
    s.Omega = 300 * theta;
    const auto [x, y] = plant.rotor.Position(s, plant.bearings[1].plane);
    EXPECT_NEAR(x, 1e-5 * std::cos(theta) - 2e-6 * std::sin(theta), 1e-20);
    EXPECT_NEAR(y, 1e-5 * std::sin(theta) + 2e-6 * std::cos(theta), 1e-20);
    EXPECT_NEAR(Reading(plant, 0, s).first, -0.135 / 0.12 * x, 1e-19);
    EXPECT_EQ(Reading(plant, 2, s).first, 0) << "the thrust bearing does not see it";
  }
}

TEST(MotionForce, BowOfAnyShapeLiesInOnePlaneAndVanishesAtTheCentreOfMass) {
  Plant plant =
      PlantOf({{"shaft-bow", "rig", {{"c", 3e-6}, {"s", 4e-6}, {"even", 2}, {"cubic", -3}}}});
  MotionState s;
  const double u = -0.135 / 0.12, shape = (u + 2 * u * u - 3 * u * u * u) / std::sqrt(14);
  EXPECT_NEAR(Reading(plant, 0, s).first, 3e-6 * shape, 1e-19);
  EXPECT_NEAR(Reading(plant, 0, s).second, 4e-6 * shape, 1e-19);
  double x = 0, y = 0;
  plant.rotor.surface[0]->Add(s, 0, &x, &y);
  EXPECT_EQ(x, 0);
  EXPECT_EQ(y, 0);
}

TEST(MotionForce, BaseModePutsAPoleAndAZero) {
  const double mass = 40, w = 2 * kPi * 60, k = mass * w * w;
  Plant plant =
      PlantOf({{"base-mode", "rig", {{"mass", mass}, {"frequency", 60}, {"damping", 0}}}});
  const std::size_t base = static_cast<std::size_t>(plant.rotor.dof()) - 2;
  MotionState s;
  s.q[base] = 1e-4;  // pole: the base alone swings at w, the rotor stays in space
  DofVector a = Accelerations(plant, s);
  EXPECT_NEAR(a[base], -w * w * 1e-4, 1e-12 * w * w);
  EXPECT_NEAR(a[0], -a[base], 1e-12);
  // Zero at w0² = k/(m + M): under f cos(w0 t) the gap stays still, q_base = -f/(k - M w0²).
  const double w0 = std::sqrt(k / (kMass + mass)), f = 10;
  s.q[base] = -f / (k - mass * w0 * w0);
  DofVector Q{};
  Q[0] = f;
  double torque;
  plant.rotor.Accelerations(s, Q, f, 0, a, &torque);
  EXPECT_NEAR(a[0], 0, 1e-12 * f);
  EXPECT_NEAR(a[base], -w0 * w0 * s.q[base], 1e-12 * f);
}

TEST(MotionForce, FloorMovesTheRotorDirectlyOrThroughTheBase) {
  const Named floor = {"base-vibration", "rig", {{"frequency", 25}, {"cx", 0.5}, {"sy", 0.3}}};
  Plant stiff = PlantOf({floor});
  MotionState s;
  EXPECT_NEAR(Accelerations(stiff, s)[0], -0.5, 1e-15);
  s.t = 0.01;  // a quarter period
  EXPECT_NEAR(Accelerations(stiff, s)[0], 0, 1e-15);
  EXPECT_NEAR(Accelerations(stiff, s)[1], -0.3, 1e-15);
  // On an undeflected spring the base, and the rotor with it, stay in space.
  Plant soft = PlantOf({{"base-mode", "rig", {{"mass", 40}}}, floor});
  const std::size_t base = static_cast<std::size_t>(soft.rotor.dof()) - 2;
  const DofVector a = Accelerations(soft, MotionState{});
  EXPECT_NEAR(a[base], -0.5, 1e-15);
  EXPECT_NEAR(a[0], 0, 1e-15);
}

// Each direction swings with its own frequency: -w² of the deflection, from k = M w².
TEST(BaseMode, IsStifferOneWay) {
  Plant plant = PlantOf(
      {{"base-mode", "rig", {{"mass", 40}, {"frequency", 20}, {"damping", 0}, {"ratio", 1.5}}}});
  const std::size_t base = static_cast<std::size_t>(plant.rotor.dof()) - 2;
  MotionState s;
  s.q[base] = s.q[base + 1] = 1e-5;
  const DofVector a = Accelerations(plant, s);
  EXPECT_NEAR(a[base], -std::pow(2 * kPi * 20, 2) * 1e-5, 1e-12);
  EXPECT_NEAR(a[base + 1], -std::pow(2 * kPi * 30, 2) * 1e-5, 1e-12);
}

}  // namespace
}  // namespace ambrig::motion
