// What `ambrig redistribute` says against what runs do: the same maps, and the forces that the
// network gives for their currents.
#include "faulttolerance/supervision/failure_map.h"

#include "faulttolerance/redistribution/redistribution_setup.h"
#include "rig/nominal_control.h"
#include "rig/rig_figures.h"
#include "tests/faulttolerance/supervision/supervised_runs.h"

namespace ambrig {
namespace {

struct Reach : ::testing::Test {
  NominalRig nominal{Rig()};
  RedistributionTable table{RedistributionProblemOf(nominal, Rig().bearings[0]),
                            ::testing::TempDir() + "ambrig_fdd_tables"};
  CurrentMap healthy = MakeBearingControl(nominal, 0).map;
  Eigen::Vector2d load{WeightShares(Rig())[0][0], WeightShares(Rig())[0][1]};
  double most = PidOf(Rig(), Rig().bearings[0]).f_max;

  MapReach Of(const std::vector<int>& failed, std::string* cls = nullptr) {
    RedistributionProblem left = table.problem();
    for (const int coil : failed) left.turns_left[coil - 1] = 0;
    CurrentMap map = healthy;
    const std::string found = MapAfterFailure(table, left.turns_left, load, {}, &map);
    if (cls) *cls = found;
    return ReachOfMap(left, map, load, most);
  }
};

TEST_F(Reach, TheHealthyBearingPullsInAllDirectionsUpToItsCommands) {
  const MapReach r = ReachOfMap(table.problem(), healthy, load, most);
  EXPECT_TRUE(r.carries);
  EXPECT_NEAR(load.norm(), 21.5, 1);  // half of 4.2 kg, nearer to A
  EXPECT_GT(r.margin, 1.4);
  EXPECT_LE(load.norm() * r.margin, most + 1e-9);
  // Downwards the command may go through zero to the other side.
  EXPECT_GT(r.radius[18], load.norm());
}

TEST_F(Reach, OneOpenCoilLeavesTheWeightWithMarginAndAllLeavesNothing) {
  std::string cls;
  const MapReach one = Of({3}, &cls);
  EXPECT_TRUE(one.carries);
  EXPECT_GT(one.margin, 1.2);
  const MapReach all = Of({1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_FALSE(all.carries);
  EXPECT_EQ(all.margin, 0);
  EXPECT_EQ(all.worst, 0);
}

// {1,2,3} stood as "exact" and dropped: what the network says agrees with runs.
TEST_F(Reach, WhatCarriesTheWeightStaysUpAndWhatDoesNotDrops) {
  for (const std::vector<int>& failed :
       {std::vector<int>{3}, {1, 2}, {1, 2, 3}, {2, 4, 6}, {1, 2, 3, 4}, {1, 2, 3, 4, 5, 6}}) {
    const MapReach r = Of(failed);
    std::string faults;
    for (const int coil : failed) faults += FaultTable(0.02, fmt::format("A.coil{}", coil), "open");
    const Outcome o = Simulated(Spin(0.1, 157, 1) + faults, Rig());
    if (!r.carries) {
      EXPECT_TRUE(o.result.touchdown) << failed.size();
    } else if (r.worst > 4) {
      EXPECT_FALSE(o.result.touchdown) << failed.size();
    }
  }
}

// A linearised W has another gain than the healthy bearing: the integrator of the position loop
// finds the command.
TEST_F(Reach, ALinearisedMapCarriesWithTheCommandThatTheIntegratorFinds) {
  CurrentMap weaker = healthy;
  weaker.W.rightCols<2>() *= 0.6;
  const MapReach r = ReachOfMap(table.problem(), weaker, load, most);
  EXPECT_TRUE(r.carries);
  EXPECT_GT(r.margin, 1.2);
  // Another sign of its gain: the command runs away.
  weaker.W.rightCols<2>() *= -1;
  EXPECT_FALSE(ReachOfMap(table.problem(), weaker, load, most).carries);
}

// A force along x that is not there is no small error of the weight along y.
TEST_F(Reach, WhatCannotBeAddedBesideTheLoadIsNotHeld) {
  CurrentMap one_way = healthy;
  one_way.W.col(1).setZero();
  const MapReach r = ReachOfMap(table.problem(), one_way, load, most);
  EXPECT_FALSE(r.carries);
  EXPECT_EQ(r.worst, 0);
  EXPECT_EQ(MarginOfMap(table.problem(), one_way, load, most), 0);
}

// Findings: with both windows of one thrust side lost the bias of the other side pressed the shaft
// to its stop for the rest of the run.
TEST(ThrustSide, WithOneSideLostTheOtherHoldsWhatPullsAgainstIt) {
  const std::string faults =
      FaultTable(0.02, "Z.coil3", "open") + FaultTable(0.02, "Z.coil4", "open");
  RigParameters rig = Rig();
  rig.detection.kind = "commissioned";
  // Against the side that is left the shaft is held as by a single magnet.
  const Outcome held =
      Simulated(Spin(0.2, 157, 1) +
                    "[[load]]\nplane = \"Z\"\nforce = -20.0\nstart = -0.2\nstop = 1.0\n" + faults,
                rig);
  EXPECT_EQ(held.Class("Z.coil3"), "open");
  EXPECT_EQ(held.Class("Z.coil4"), "open");
  EXPECT_FALSE(held.result.touchdown);
}

}  // namespace
}  // namespace ambrig
