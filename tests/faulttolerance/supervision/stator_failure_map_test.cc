// The map of any stator after failures: what of the healthy map the problem takes, and which
// currents come of it.
#include "faulttolerance/supervision/stator_failure_map.h"

#include <gtest/gtest.h>

#include "actuators/magnetics/stator_parameters.h"
#include "control/current/bias_linearisation.h"

namespace ambrig {
namespace {

/// Six poles, one coil each, unipolar amplifiers of 5 A.
struct SixPoles {
  SixPoles() {
    StatorParameters p;
    p.pattern = "one-coil-per-pole";
    p.turns = 60;
    p.pole_area = 1e-4;
    p.gap = 3e-4;
    p.pole_count = 6;
    p.leakage_inductance = 3e-4;
    p.resistance = 1;
    network = NetworkOf(p);
    const BiasLinearisation at = LineariseAtBias(*network, 1.5, 2);
    healthy.W.topRows(6) = at.W;
    healthy.k = at.k;
    healthy.c0 = at.c0;
    healthy.i_max = 5;
    healthy.unipolar = true;
  }
  std::shared_ptr<const PoleNetwork> network;
  CurrentMap healthy;
};

TEST(StatorFailureMap, TheProblemIsThatOfTheHealthyMap) {
  const SixPoles s;
  CoilVector turns = CoilVector::Ones();
  turns[2] = 0.4;
  const StatorProblem p = StatorProblemOf(s.network, 2, s.healthy, turns, {0, 0});
  EXPECT_EQ(p.axes, 2);
  EXPECT_EQ(p.healthy, s.healthy.W.topRows(6));
  EXPECT_EQ(p.turns_left.size(), 6);
  EXPECT_EQ(p.turns_left[2], 0.4);
  EXPECT_EQ(p.k, s.healthy.k);
  EXPECT_EQ(p.c0, s.healthy.c0);
  EXPECT_EQ(p.i_max, 5);
  EXPECT_TRUE(p.unipolar);
}

// With one coil lost the force is what was asked for, with the turns that are left, and no current
// is beyond the amplifier.
TEST(StatorFailureMap, TheNewMapGivesTheForceWithoutTheLostCoil) {
  const SixPoles s;
  CoilVector turns = CoilVector::Ones();
  turns[1] = 0;
  CurrentMap map = s.healthy;
  const std::string cls =
      StatorMapAfterFailure(StatorProblemOf(s.network, 2, s.healthy, turns, {0, 0}), true, &map);
  EXPECT_EQ(cls, "exact");
  EXPECT_EQ(map.W.row(1).norm(), 0);
  for (const auto& [fx, fy] : {std::pair{0.0, 0.0}, {4.0, 0.0}, {-3.0, 5.0}}) {
    const CoilVector i = map.SetPoints(fx, fy);
    const Eigen::VectorXd six = i.head(6).cwiseProduct(turns.head(6));
    const Eigen::Vector3d f = s.network->Force(Eigen::Vector3d::Zero(), six);
    EXPECT_NEAR(f.x(), fx, 1e-6);
    EXPECT_NEAR(f.y(), fy, 1e-6);
    EXPECT_LE(i.maxCoeff(), 5);
    EXPECT_GE(i.minCoeff(), 0);
  }
  // What of the healthy bearing's negative stiffness is lost destabilises nothing: it is only given
  // back where it grew.
  CurrentMap plain = s.healthy;
  StatorMapAfterFailure(StatorProblemOf(s.network, 2, s.healthy, turns, {0, 0}), false, &plain);
  EXPECT_EQ(plain.stiffness_change.norm(), 0);
  EXPECT_EQ(plain.W, map.W);
}

TEST(StatorFailureMap, WhereNothingCanBeDoneTheOthersGoOn) {
  const SixPoles s;
  CoilVector turns = CoilVector::Zero();
  turns[4] = 1;
  CurrentMap map = s.healthy;
  EXPECT_EQ(
      StatorMapAfterFailure(StatorProblemOf(s.network, 2, s.healthy, turns, {0, 0}), true, &map),
      "none");
  for (int j = 0; j < 6; ++j) {
    if (j == 4) {
      EXPECT_EQ(map.W.row(j), s.healthy.W.row(j));
    } else {
      EXPECT_EQ(map.W.row(j).norm(), 0) << j;
    }
  }
}

}  // namespace
}  // namespace ambrig
