// Where a levitated rotor stands: what it carries, where its sensors read zero, and when it cannot.
#include "analysis/linear/equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "actuators/magnetics/coil_network.h"
#include "rig/nominal_control.h"
#include "rig/rig_figures.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

struct Standing {
  RigParameters rig;
  Plant plant;
  std::vector<BearingControl> control;
  Equilibrium at;

  explicit Standing(const RigParameters& of) : rig(of), plant(BuildPlant(TrueRig(of))) {
    for (std::size_t k = 0; k < rig.bearings.size(); ++k)
      control.push_back(MakeBearingControl(NominalRig(rig), k));
    at = LevitatedEquilibrium(rig, plant, control);
  }
  /// Magnetic force of all bearings along x, y, z with the equilibrium's currents, by the circuit
  /// [N].
  Eigen::Vector3d Magnets() const {
    Eigen::Vector3d f = Eigen::Vector3d::Zero();
    MotionState s;
    s.q = at.q;
    for (std::size_t k = 0; k < plant.bearings.size(); ++k) {
      const BearingPlant& b = plant.bearings[k];
      const PlanePoint p = plant.rotor.Position(s, b.plane);
      double lambda[kMaxWindings] = {};
      NetworkState n;
      const CoilNetwork network(b.lanes);
      network.Linkages(at.current[k].v, p.x, p.y, lambda);
      network.Solve(lambda, p.x, p.y, n);
      DofVector Q{};
      b.plane.AddForce(n.fx, n.fy, Q);
      f += Eigen::Vector3d(Q[0], Q[1], Q[2]);
    }
    return f;
  }
};

// At the centre the healthy map is exact: each command is the bearing's share of the weight.
TEST(Equilibrium, AtTheCentreTheCommandsAreTheWeight) {
  const Standing s(ReferenceRig());
  ASSERT_TRUE(s.at.converged) << s.at.message;
  EXPECT_TRUE(s.at.usable());
  EXPECT_LT(s.at.residual, 1e-6);
  const std::vector<double> weight = WeightOverAxes(s.rig);
  ASSERT_EQ(s.at.force.size(), weight.size());
  for (std::size_t k = 0; k < weight.size(); ++k)
    EXPECT_NEAR(s.at.force[k], weight[k], 1e-6 * s.rig.rotor.mass * 9.81) << k;
  for (int d = 0; d < s.plant.rotor.dof(); ++d)
    EXPECT_NEAR(s.at.q[static_cast<std::size_t>(d)], 0, 1e-11) << d;
  EXPECT_LT((s.Magnets() - Eigen::Vector3d(0, 4.2 * 9.81, 0)).norm(), 1e-5);
}

// A ball under one magnet: nothing pulls it sideways or tilts it, and the pull along its axis is
// the weight.
TEST(Equilibrium, OfOneAxisIsUnique) {
  const Standing s(ReadRig(AMBRIG_SOURCE_DIR "/examples/mls2em/rig.toml"));
  ASSERT_TRUE(s.at.converged) << s.at.message;
  EXPECT_NEAR(s.Magnets().y(), 0.0605 * 9.81, 1e-6);
  for (int d = 0; d < s.plant.rotor.dof(); ++d) {
    if (d == 1) continue;
    EXPECT_EQ(s.at.q[static_cast<std::size_t>(d)], 0) << d;
  }
}

TEST(Equilibrium, WithoutWeightEveryCoilHasItsBias) {
  RigParameters rig = ReferenceRig();
  rig.gravity = {0, 0, 0};
  const Standing s(rig);
  ASSERT_TRUE(s.at.converged);
  for (std::size_t k = 0; k < rig.bearings.size(); ++k)
    for (int j = 0; j < rig.bearings[k].coils(); ++j)
      EXPECT_NEAR(s.at.current[k][j], BiasCurrent(rig, rig.bearings[k]), 1e-9);
}

// Stood on end the thrust bearing carries it all.
TEST(Equilibrium, OnEndTheThrustBearingCarriesTheWeight) {
  RigParameters rig = ReferenceRig();
  rig.gravity = {0, 0, -9.81};
  const Standing s(rig);
  ASSERT_TRUE(s.at.converged);
  EXPECT_NEAR(s.at.force.back(), 4.2 * 9.81, 1e-4);
  EXPECT_LT((s.Magnets() - Eigen::Vector3d(0, 0, 4.2 * 9.81)).norm(), 1e-4);
}

TEST(Equilibrium, ARotorTooHeavyHasNone) {
  RigParameters rig = ReferenceRig();
  rig.rotor.mass = 400;
  const Standing s(rig);
  EXPECT_FALSE(s.at.converged);
  EXPECT_FALSE(s.at.usable());
  EXPECT_FALSE(s.at.message.empty());
}

TEST(Equilibrium, AxesAreTwoOfARadialBearingElseOne) {
  const Standing s(ReferenceRig());
  EXPECT_EQ(AxesOf(s.plant.bearings[0]), 2u);
  EXPECT_EQ(AxesOf(s.plant.bearings[2]), 1u);
  RigParameters magnet = ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/mls2em/rig.toml");
  EXPECT_EQ(AxesOf(BuildPlant(TrueRig(magnet)).bearings[0]), 1u);
}

}  // namespace
}  // namespace ambrig
