// The inverse in the place of a map: it searches anew where its branch has ended, and then rests.
#include "faulttolerance/redistribution/inverse_allocation.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/faulttolerance/redistribution_reference.h"

namespace ambrig {
namespace {

RedistributionProblem FourQuadrants() {
  RedistributionProblem p = MakeRedistributionProblem(std::numbers::pi / 8, "NSNSNSNS");
  p.quadrants = 2;
  return p;
}

TEST(InverseAllocation, FollowsForcesAndAddsTheStiffnessThatTheControllerKnows) {
  ForceInverse inverse(FourQuadrants());
  ASSERT_TRUE(inverse.Start({0, 40}));
  const Eigen::Matrix2d stiffness = 1e5 * Eigen::Matrix2d::Identity();
  InverseAllocation allocation(inverse, stiffness);
  const NetworkForce network(FourQuadrants());
  CoilVector current;
  for (int n = 0; n < 20; ++n) current = allocation.Step(0.5 * n, 40 + n, 0, 0);
  EXPECT_NEAR((network.Force(current) - Eigen::Vector2d(9.5, 59)).norm(), 0, 0.05);
  EXPECT_EQ(allocation.LastForce(), Eigen::Vector2d(9.5, 59));
  EXPECT_EQ(allocation.searches(), 0);
  NetworkForce moved(FourQuadrants());
  moved.MoveTo(2e-5, 0);
  for (int n = 0; n < 20; ++n) current = allocation.Step(9.5, 59, 2e-5, 0);
  EXPECT_NEAR((moved.Force(current) - Eigen::Vector2d(9.5 + 1e5 * 2e-5, 59)).norm(), 0, 0.05);
}

// Without any current the force has no gradient and no step leads anywhere: after eight periods a
// search finds currents, and the force is met from then on.
TEST(InverseAllocation, SearchesOnceWhereItIsStuck) {
  ForceInverse stuck(FourQuadrants());
  stuck.SetCurrents(CoilVector::Zero());
  InverseAllocation allocation(stuck, Eigen::Matrix2d::Zero());
  const NetworkForce network(FourQuadrants());
  int first = 0;
  for (int n = 1; n <= 40; ++n) {
    allocation.Step(20, 30, 0, 0);
    if (first == 0 && allocation.searches() == 1) first = n;
  }
  EXPECT_EQ(first, 8);
  EXPECT_EQ(allocation.searches(), 1);
  EXPECT_NEAR((network.Force(allocation.Step(20, 30, 0, 0)) - Eigen::Vector2d(20, 30)).norm(), 0,
              0.05);
}

// A coil without current cannot go below it where currents have one sign: it gives no control
// there.
TEST(InverseAllocation, ACoilAtItsLimitGivesNoControl) {
  for (const int quadrants : {2, 4}) {
    RedistributionProblem p = FourQuadrants();
    p.quadrants = quadrants;
    ForceInverse inverse(p);
    CoilVector one = CoilVector::Zero();
    one[2] = 2;
    inverse.SetCurrents(one);
    if (quadrants == 2) {
      EXPECT_LT(inverse.least_gain(), 1e-6);  // one coil, one direction
    } else {
      EXPECT_GT(inverse.least_gain(), 0.1);
    }
    inverse.SetCurrents(CoilVector::Constant(p.i_max));
    EXPECT_EQ(inverse.least_gain(), 0);
    inverse.SetCurrents(HealthyDistribution(p).col(0) * p.c0);
    EXPECT_NEAR(inverse.least_gain(), 1, 1e-9);
  }
}

}  // namespace
}  // namespace ambrig
