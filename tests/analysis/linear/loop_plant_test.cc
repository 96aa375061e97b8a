/// The linear loop that analyses and syntheses share: currents by coil and by axis' pattern.
#include "analysis/linear/loop_plant.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/linear/control_plant.h"
#include "core/math/constants.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig {
namespace {

const std::vector<std::size_t> kAxes{0, 1, 2, 3, 4};

RigParameters RigUnderGravity(double g) {
  RigParameters rig = RigWith("kind = \"pid\"\n" + kPidGains);
  rig.gravity = {0, -g, 0};
  return rig;
}

/// Largest relative difference between the responses of the two models of the currents.
double Difference(const RigParameters& rig, double hertz) {
  const OperatingPoint point = FindOperatingPoint(rig);
  const auto response = [&](CurrentModel currents) {
    const SampledPlant p = MakeControlPlant(point, kAxes, 300, currents);
    return p.FromForce().Response(std::polar(1.0, 2 * kPi * hertz * p.Ts));
  };
  const Eigen::MatrixXcd exact = response(CurrentModel::kCoils);
  return (response(CurrentModel::kAxisPatterns) - exact).norm() / exact.norm();
}

// Unloaded, the stator is symmetric: the pattern of an axis excites no other pattern, and one
// current per axis says all that the coils say.
TEST(LoopPlant, PatternsAreExactWithoutWeight) {
  for (const double hertz : {5.0, 60.0, 400.0, 2500.0})
    EXPECT_LT(Difference(RigUnderGravity(0), hertz), 1e-9) << hertz;
}

// The weight makes the coils unequal. What the other patterns then do is of second order in
// weight/bias: a quarter at half the weight.
TEST(LoopPlant, PatternsErrInTheSquareOfTheWeight) {
  for (const double hertz : {60.0, 400.0}) {
    const double whole = Difference(RigUnderGravity(9.81), hertz),
                 half = Difference(RigUnderGravity(9.81 / 2), hertz);
    EXPECT_LT(whole, 0.02) << hertz;
    EXPECT_NEAR(half / whole, 0.25, 0.05) << hertz;
  }
}

// At constant current the reduced bearing has the forces of the whole one, by its definition.
TEST(LoopPlant, PatternsKeepForceAndStiffness) {
  const OperatingPoint point = FindOperatingPoint(RigUnderGravity(9.81));
  const LinearBearing& b = point.bearings[0];
  Eigen::MatrixXd pattern(static_cast<Eigen::Index>(b.coils.size()), 2);
  for (Eigen::Index k = 0; k < pattern.rows(); ++k)
    pattern.row(k) = point.control()[0].map.W.row(b.coils[static_cast<std::size_t>(k)]).tail(2);
  const LinearBearing reduced = OntoPatterns(b, pattern);
  EXPECT_LT((reduced.NegativeStiffness() - b.NegativeStiffness()).norm(),
            1e-9 * b.NegativeStiffness().norm());
  const Eigen::MatrixXd force = b.ForceOfCurrent() * pattern;
  EXPECT_LT((reduced.ForceOfCurrent() - force).norm(), 1e-9 * force.norm());
  // Voltage on the pattern: L of the pattern, by energy v' P' L P v = (P' P) v' l v here.
  const Eigen::MatrixXd energy = pattern.transpose() * b.Inductance() * pattern;
  EXPECT_LT((pattern.transpose() * pattern * reduced.Inductance() - energy).norm(),
            1e-9 * energy.norm());
}

// A force held over a tick is the same as the continuous one of frequency zero.
TEST(LoopPlant, HeldForceIsTheSlowHarmonic) {
  const OperatingPoint point = FindOperatingPoint(RigUnderGravity(9.81));
  const LoopPlant loop(point, LinearisePlant(point, 300));
  for (Eigen::Index q = 0; q < loop.plant().m(); ++q) {
    HarmonicInput slow;
    slow.omega = 1e-3;
    slow.pushed = Eigen::VectorXcd::Unit(loop.plant().m(), q);
    const Eigen::VectorXd held = loop.E.col(q), harmonic = loop.Disturbance(slow).real();
    EXPECT_LT((held - harmonic).norm(), 1e-6 * held.norm()) << q;
  }
}

// Only the bearings asked for pull: without the thrust bearing its axis is not in the plant.
TEST(LoopPlant, LeavesOutOtherBearings) {
  const OperatingPoint point = FindOperatingPoint(RigUnderGravity(9.81));
  const std::vector<std::size_t> radial{0, 1, 2, 3};
  const LinearPlant p = LinearisePlant(point, 0, CurrentModel::kCoils, &radial);
  EXPECT_EQ(p.axes(), 4);
  EXPECT_EQ(p.m(), 4);  // x, y, alpha, beta
  for (const PlantCoil& c : p.coils) EXPECT_LT(c.bearing, 2u);
  EXPECT_EQ(LinearisePlant(point, 0).m(), 5);
  const std::vector<std::size_t> half{0, 2};
  EXPECT_THROW(LinearisePlant(point, 0, CurrentModel::kCoils, &half), std::logic_error);
}

}  // namespace
}  // namespace ambrig
