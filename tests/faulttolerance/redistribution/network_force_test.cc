// The force of a bearing with failed coils: against the simulator's stator, its own derivatives,
// and the symmetries of the winding.
#include "faulttolerance/redistribution/network_force.h"

#include <gtest/gtest.h>

#include <cmath>

#include "actuators/magnetics/radial_stator.h"
#include "faulttolerance/redistribution/bearing_symmetry.h"
#include "faulttolerance/supervision/map_checks.h"
#include "tests/faulttolerance/redistribution_reference.h"

namespace ambrig {
namespace {

RedistributionProblem Problem(const char* winding = "NSNSNSNS") {
  return MakeRedistributionProblem(22.5 * std::acos(-1.0) / 180, winding);
}

RadialStator StatorOf(const RedistributionProblem& p, const char* winding) {
  RadialStatorParameters s;
  s.first_pole_angle_deg = 22.5;
  s.winding = winding;
  s.turns = p.turns;
  s.pole_area = p.pole_area;
  s.gap = p.gap;
  s.leakage_inductance = 3.5e-4;
  s.resistance = 0.5;
  return RadialStator(s);
}

CoilVector Currents(double seed) {
  CoilVector i;
  for (int j = 0; j < 8; ++j) i[j] = 2 + std::sin(seed + 1.7 * j);
  return i;
}

TEST(NetworkForce, IsThatOfTheSimulatorsStator) {
  for (const char* winding : {"NSNSNSNS", "NNSSNNSS"}) {
    const RedistributionProblem p = Problem(winding);
    const RadialStator stator = StatorOf(p, winding);
    NetworkForce force(p);
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1e-4, -5e-5}, {-1.5e-4, 1.2e-4}}) {
      force.MoveTo(x, y);
      const Eigen::Vector2d ours = force.Force(Currents(x)),
                            theirs = stator.Force({x, y}, Currents(x));
      EXPECT_LT((ours - theirs).norm(), 1e-9 * theirs.norm()) << winding << " " << x;
    }
  }
}

// A coil without turns pulls at nothing, whatever flows in it; half the turns need twice the
// current.
TEST(NetworkForce, ShortedTurnsScaleTheirCurrent) {
  RedistributionProblem whole = Problem(), half = Problem(), dead = Problem();
  half.turns_left[2] = 0.5;
  dead.turns_left[2] = 0;
  CoilVector i = Currents(1), twice = i, other = i;
  twice[2] *= 2;
  other[2] = 77;
  EXPECT_LT((NetworkForce(half).Force(twice) - NetworkForce(whole).Force(i)).norm(), 1e-9);
  EXPECT_LT((NetworkForce(dead).Force(other) - NetworkForce(dead).Force(i)).norm(), 1e-12);
}

TEST(NetworkForce, GradientIsTheDerivativeOverTheCurrents) {
  RedistributionProblem p = Problem();
  p.turns_left[5] = 0;
  NetworkForce force(p);
  force.MoveTo(8e-5, -6e-5);
  const CoilVector i = Currents(2);
  ForceGradient gradient;
  EXPECT_LT((force.Force(i, &gradient) - force.Force(i)).norm(), 1e-9);
  EXPECT_EQ(gradient.col(5).norm(), 0);
  const double h = 1e-4;  // the force is quadratic: central differences are exact
  for (int j = 0; j < 8; ++j) {
    CoilVector plus = i, minus = i;
    plus[j] += h;
    minus[j] -= h;
    const Eigen::Vector2d slope = (force.Force(plus) - force.Force(minus)) / (2 * h);
    EXPECT_LT((gradient.col(j) - slope).norm(), 1e-7) << j;
  }
}

// F_a = i'Q^a i: with y the same vector in one row, the contraction gives back the force, i'(Q^a
// i).
TEST(NetworkForce, ContractionIsHalfTheGradientOfItsVector) {
  NetworkForce force(Problem());
  force.MoveTo(-9e-5, 3e-5);
  const CoilVector i = Currents(3);
  for (int a = 0; a < 2; ++a) {
    ForceGradient y = ForceGradient::Zero();
    y.row(a) = i.transpose();
    EXPECT_NEAR(force.Contract(y).dot(i), force.Force(i)[a], 1e-9);
  }
}

// Fluxes in air only: the forces are gradients of one energy, so the stiffness at fixed fluxes
// would be symmetric; at fixed currents it is too (co-energy), and it pulls away: a positive trace.
TEST(NetworkForce, StiffnessIsSymmetricAndPullsAway) {
  NetworkForce force(Problem());
  for (const double seed : {0.0, 1.0, 2.5}) {
    const Eigen::Matrix2d k = force.Stiffness(Currents(seed));
    EXPECT_NEAR(k(0, 1), k(1, 0), 1e-3 * k.norm());
    EXPECT_GT(k.trace(), 0);
  }
  // With the bias alone all axes are alike.
  const Eigen::Matrix2d k = force.Stiffness(CoilVector::Constant(2));
  EXPECT_NEAR(k(0, 0), k(1, 1), 1e-4 * k.norm());
  EXPECT_NEAR(k(0, 1), 0, 1e-4 * k.norm());
}

TEST(NetworkForce, GapsStayOpen) {
  NetworkForce force(Problem());
  force.MoveTo(1, 0);  // far beyond the poles
  EXPECT_TRUE(std::isfinite(force.Force(Currents(0)).norm()));
}

TEST(BearingSymmetry, CountsThoseOfBothWindings) {
  EXPECT_EQ(FindSymmetries(Problem()).size(), 16u);
  EXPECT_EQ(FindSymmetries(Problem("NNSSNNSS")).size(), 8u);
  EXPECT_GE(FindSymmetries(Problem("NNNSNSSS")).size(), 1u);
}

// The force of mapped currents is the force turned with them: that is what a symmetry is.
TEST(BearingSymmetry, MappedCurrentsGiveTheTurnedForce) {
  for (const char* winding : {"NSNSNSNS", "NNSSNNSS"}) {
    const RedistributionProblem p = Problem(winding);
    const NetworkForce force(p);
    const CoilVector i = Currents(4);
    for (const BearingSymmetry& s : FindSymmetries(p)) {
      EXPECT_LT((force.Force(Mapped(s, i)) - s.R * force.Force(i)).norm(), 1e-9);
      EXPECT_NEAR(std::abs(s.R.determinant()), 1, 1e-12);
    }
  }
}

TEST(BearingSymmetry, MapsOfDistributionsAreUndone) {
  const RedistributionProblem p = Problem();
  DistributionMatrix W;
  for (int r = 0; r < W.rows(); ++r)
    for (int c = 0; c < W.cols(); ++c) W(r, c) = std::sin(1.0 + 3 * r + c);
  const Eigen::Vector2d v(0.3, -0.7);
  for (const BearingSymmetry& s : FindSymmetries(p)) {
    const DistributionMatrix M = Mapped(s, W);
    EXPECT_LT((MappedBack(s, M) - W).norm(), 1e-12);
    // The mapped W gives for a turned command the mapped currents.
    const Eigen::Vector2d turned = s.R * v;
    const CoilVector before = W * Eigen::Vector3d(1, v.x(), v.y()),
                     after = M * Eigen::Vector3d(1, turned.x(), turned.y());
    EXPECT_LT((after - Mapped(s, before)).norm(), 1e-12);
  }
}

// All single failures of the alternating winding are one; pairs fall into as many as distances.
TEST(BearingSymmetry, CanonicalSetsAreShared) {
  const auto symmetries = FindSymmetries(Problem());
  const auto canonical = [&](std::initializer_list<int> failed) {
    CoilVector left = CoilVector::Ones();
    for (const int j : failed) left[j] = 0;
    return Mapped(ToCanonical(symmetries, left), left);
  };
  for (int j = 1; j < 8; ++j) EXPECT_EQ(canonical({j}), canonical({0}));
  EXPECT_EQ(canonical({0, 1}), canonical({5, 6}));
  EXPECT_EQ(canonical({0, 3}), canonical({2, 7}));
  EXPECT_NE(canonical({0, 1}), canonical({0, 2}));
}

TEST(MapChecks, TheDestabilisingPartIsThatOfNegativeEigenvalues) {
  const double c = std::cos(0.6), s = std::sin(0.6);
  const Eigen::Matrix2d turn = (Eigen::Matrix2d() << c, -s, s, c).finished();
  const Eigen::Matrix2d change = turn * Eigen::Vector2d(-3e4, 5e4).asDiagonal() * turn.transpose();
  const Eigen::Matrix2d expected = turn * Eigen::Vector2d(-3e4, 0).asDiagonal() * turn.transpose();
  EXPECT_LT((DestabilisingPart(change) - expected).norm(), 1e-6);
  EXPECT_EQ(DestabilisingPart(Eigen::Matrix2d::Identity()).norm(), 0);
}

TEST(MapChecks, TheCommandedForceComesBackFromItsSetPoints) {
  CurrentMap map;
  map.k = 12;
  map.c0 = 2;
  map.i_max = 100;
  map.unipolar = false;
  for (int j = 0; j < 8; ++j)
    map.W.row(j) << 1, std::cos(0.4 + 0.785 * j), std::sin(0.4 + 0.785 * j);
  const CoilVector i = map.SetPoints(7, -11);
  EXPECT_LT((CommandedForce(map, i) - Eigen::Vector2d(7, -11)).norm(), 1e-6);
}

TEST(MapChecks, AnExactDistributionGivesItsForceAndAFailedOneDoesNot) {
  Distribution d;
  d.cls = SolvabilityClass::kExact;
  EXPECT_TRUE(GivesForce({5, 5}, Problem(), d, {}));
  d.cls = SolvabilityClass::kLinearised;
  d.residual = 2;  // leaves more open than it solves
  EXPECT_FALSE(GivesForce({5, 5}, Problem(), d, {}));
}

}  // namespace
}  // namespace ambrig
