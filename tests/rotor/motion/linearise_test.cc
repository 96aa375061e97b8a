/// The linear equations say what the nonlinear rotor does for small motion: accelerations of
/// RotorModel at small random states and forces, for every kind of moving part.
#include "rotor/motion/linearise.h"

#include <gtest/gtest.h>

#include <random>

#include "rig/rig_assembly.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

RigParameters ReferenceRig() {
  return ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
}

EffectInstance Effect(const std::string& text) {
  const RigParameters rig = ReferenceRig();
  return ReadEffect(TomlTable::FromText(text, "effect.toml"), TargetsOfEffects(rig));
}

struct Small {
  MotionState s;
  DofVector Q{};
  Eigen::VectorXd q, v, force;
  double stator[2] = {0, 0};
};

/// Motion far inside every clearance, magnets' forces through the ports.
Small RandomMotion(const Plant& plant, const LinearRotor& linear, double speed, int seed) {
  std::mt19937 draw(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> unit(-1, 1);
  Small m;
  m.s.Omega = speed;
  m.q.setZero(plant.rotor.dof());
  m.v.setZero(plant.rotor.dof());
  m.force.setZero(plant.rotor.dof());
  for (int d = 0; d < plant.rotor.dof(); ++d) {
    const auto u = static_cast<std::size_t>(d);
    m.q(d) = m.s.q[u] = 1e-6 * unit(draw);
    m.v(d) = m.s.v[u] = 1e-3 * unit(draw);
  }
  for (std::size_t k = 0; k < plant.bearings.size(); ++k) {
    const BearingPlant& b = plant.bearings[k];
    const double fx = unit(draw), fy = b.thrust ? 0 : unit(draw);
    b.plane.AddForce(fx, fy, m.Q);
    if (!b.thrust) m.stator[0] += fx, m.stator[1] += fy;
    m.force += linear.ports[k].B.col(0) * fx;
    if (!b.thrust) m.force += linear.ports[k].B.col(1) * fy;
  }
  return m;
}

TEST(LinearRotor, AccelerationsAreTheModels) {
  const char* effects[] = {
      "",
      "name = \"cross-coupling\"\ntarget = \"A\"\nparameters = { stiffness = 2e4 }",
      "name = \"rotating-damping\"\nparameters = { damping = 30.0 }",
      "name = \"base-mode\"\nparameters = { mass = 30.0, frequency = 50.0, damping = 0.03 }",
      "name = \"bending-mode\"\nparameters = { frequency = 210.0, gain_a = 0.4, gain_b = -0.3, "
      "gyro = "
      "0.2 }",
      "name = \"contact-mount\"\ntarget = \"A\"\nparameters = { stiffness = 1e6, damping = 200.0, "
      "mass = 0.2 "
      "}"};
  for (int twice = 0; twice < 2; ++twice)  // also all of them together
    for (const char* effect : effects) {
      RigParameters rig = ReferenceRig();
      rig.gravity = {0, 0, 0};  // a constant, no part of the matrices
      for (const char* other : effects)
        if (*other && (twice || other == effect)) rig.effects.push_back(Effect(other));
      const Plant plant = BuildPlant(TrueRig(rig));
      const double speed = 700;
      const LinearRotor linear = LinearRotorOf(plant, speed);
      const Small m = RandomMotion(plant, linear, speed, 5);
      DofVector a{};
      double torque = 0;
      plant.rotor.Accelerations(m.s, m.Q, m.stator[0], m.stator[1], a, &torque);
      const Eigen::VectorXd ours = linear.M.partialPivLu().solve(
          m.force - linear.K * m.q - (linear.D + speed * linear.G) * m.v);
      double size = 0;
      for (int d = 0; d < plant.rotor.dof(); ++d) size = std::max(size, std::abs(ours(d)));
      // Differences of linear terms: rounding of numbers of this size over the step of 1e-7.
      for (int d = 0; d < plant.rotor.dof(); ++d)
        EXPECT_NEAR(a[static_cast<std::size_t>(d)], ours(d), 1e-7 * size)
            << effect << " coordinate " << d;
    }
}

TEST(LinearRotor, AlsoOfABeamWithFullGyroscopicCoupling) {
  RigParameters rig = ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/tum_mbtr/rig.toml");
  rig.gravity = {0, 0, 0};
  rig.effects.clear();
  const Plant plant = BuildPlant(TrueRig(rig));
  const double speed = 700;
  const LinearRotor linear = LinearRotorOf(plant, speed);
  const Small m = RandomMotion(plant, linear, speed, 3);
  DofVector a{};
  double torque = 0;
  plant.rotor.Accelerations(m.s, m.Q, m.stator[0], m.stator[1], a, &torque);
  const Eigen::VectorXd ours =
      linear.M.partialPivLu().solve(m.force - linear.K * m.q - (linear.D + speed * linear.G) * m.v);
  for (int d = 0; d < plant.rotor.dof(); ++d)
    EXPECT_NEAR(a[static_cast<std::size_t>(d)], ours(d), 1e-10 * ours.cwiseAbs().maxCoeff()) << d;
  EXPECT_LT((linear.G + linear.G.transpose()).norm(), 1e-15 * linear.G.norm());
  EXPECT_GT(std::abs(linear.G(3, 5)), 0);  // tilt and bending
  EXPECT_GT(std::abs(linear.G(5, 8)), 0);  // bending and bending
}

TEST(LinearRotor, PortsReadAndPushWhereTheRigDoes) {
  const Plant plant = BuildPlant(TrueRig(ReferenceRig()));
  const LinearRotor linear = LinearRotorOf(plant);
  ASSERT_EQ(linear.ports.size(), 3u);
  const LinearPort& a = linear.ports[0];
  EXPECT_EQ(a.name, "A");
  EXPECT_DOUBLE_EQ(a.C(0, 4), -0.135);  // x + z beta at the sensor
  EXPECT_DOUBLE_EQ(a.C(1, 3), 0.135);   // y - z alpha
  EXPECT_DOUBLE_EQ(a.gap(0, 4), -0.12);
  EXPECT_DOUBLE_EQ(a.B(4, 0), -0.12);  // My = z fx
  EXPECT_EQ(linear.ports[2].C.rows(), 1);
  EXPECT_DOUBLE_EQ(linear.ports[2].B(2, 0), 1);
}

}  // namespace
}  // namespace ambrig
