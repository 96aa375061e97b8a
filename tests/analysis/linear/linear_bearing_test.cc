// Derivatives of the magnetic circuit: closed forms of the centred bearing, and differences of the
// exact circuit at a displaced one.
#include "analysis/linear/linear_bearing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "actuators/magnetics/coil_network.h"
#include "core/math/constants.h"
#include "rig/rig_assembly.h"
#include "tests/effects/effect_rigs.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

/// The linearisation of `lanes` at a displaced point against differences of its exact circuit.
void CheckDerivatives(const StatorLanes& lanes, const Lane& current, double x, double y) {
  const LinearBearing b = LineariseBearing(lanes, current, x, y);
  const CoilNetwork network(lanes);
  double lambda[kMaxWindings] = {};
  network.Linkages(current.v, x, y, lambda);
  const auto solve = [&](double dx, double dy, int coil, double d) {
    double moved[kMaxWindings];
    std::copy(lambda, lambda + kPoles, moved);
    moved[coil] += d;
    NetworkState s;
    network.Solve(moved, x + dx, y + dy, s);
    Eigen::Matrix<double, 10, 1> out;
    for (int j = 0; j < kPoles; ++j) out[j] = s.i[static_cast<std::size_t>(j)];
    out[8] = s.fx;
    out[9] = s.fy;
    return out;
  };
  // Central differences; truncation (h/g0)² = 6e-10 of a derivative, rounding 1e-16/(h/g0).
  const double h = 1e-8, dl = 1e-7;
  for (int axis = 0; axis < 2; ++axis) {
    const auto slope = ((solve(axis == 0 ? h : 0, axis == 1 ? h : 0, 0, 0) -
                         solve(axis == 0 ? -h : 0, axis == 1 ? -h : 0, 0, 0)) /
                        (2 * h))
                           .eval();
    EXPECT_LT((slope.head<8>() - b.I_r.col(axis)).norm(), 1e-6 * b.I_r.norm());
    EXPECT_LT((slope.tail<2>() - b.F_r.col(axis)).norm(), 1e-6 * b.F_r.norm());
  }
  for (int j = 0; j < kPoles; ++j) {
    const auto slope = ((solve(0, 0, j, dl) - solve(0, 0, j, -dl)) / (2 * dl)).eval();
    EXPECT_LT((slope.head<8>() - b.I_lambda.col(j)).norm(), 1e-6 * b.I_lambda.norm());
    EXPECT_LT((slope.tail<2>() - b.F_lambda.col(j)).norm(), 1e-6 * b.F_lambda.norm());
  }
}

class Bearing : public ::testing::Test {
 protected:
  const RigParameters rig_ = BaseRig();
  const Plant plant_ = BuildPlant(TrueRig(rig_));
  const StatorLanes& lanes_ = plant_.bearings[0].lanes;
};

// published_values.md 2.1: f = 4 kappa i0 (ix, iy), k_s = 4 kappa i0²/g0; leakage changes neither.
TEST_F(Bearing, CentredConstants) {
  const RadialStatorParameters& p = rig_.bearings[0].radial;
  const double kappa = kMu0 * p.turns * p.turns * p.pole_area / (p.gap * p.gap), i0 = 2;
  Lane bias{};
  for (int j = 0; j < kPoles; ++j) bias[j] = i0;
  const LinearBearing b = LineariseBearing(lanes_, bias, 0, 0);
  ASSERT_EQ(b.coils.size(), 8u);
  const RadialStator stator(p);
  const Eigen::Vector2d ki(b.ForceOfCurrent().row(0) * stator.cosine(),
                           b.ForceOfCurrent().row(1) * stator.cosine());
  EXPECT_NEAR(ki.x(), 4 * kappa * i0, 1e-9 * ki.x());
  EXPECT_NEAR(ki.y(), 0, 1e-9 * ki.x());
  const Eigen::Matrix2d ks = b.NegativeStiffness();
  EXPECT_NEAR(ks(0, 0), 4 * kappa * i0 * i0 / p.gap, 1e-9 * ks(0, 0));
  EXPECT_NEAR(ks(1, 1), ks(0, 0), 1e-9 * ks(0, 0));
  EXPECT_NEAR(ks(0, 1), 0, 1e-9 * ks(0, 0));
  // L of the stator itself.
  EXPECT_LT((b.Inductance() - stator.Inductance({0, 0})).norm(), 1e-9 * b.Inductance().norm());
}

constexpr double kX = 5e-5, kY = -8e-5;

Lane UnequalCurrents() {
  Lane current{};
  for (int j = 0; j < kPoles; ++j) current[j] = 1 + 0.3 * j;
  return current;
}

TEST_F(Bearing, DerivativesAreThoseOfTheDisplacedCircuit) {
  CheckDerivatives(lanes_, UnequalCurrents(), kX, kY);
  const LinearBearing b = LineariseBearing(lanes_, UnequalCurrents(), kX, kY);
  // Reciprocity: dλ/dx at constant current is df/di at constant position (published_values.md 1.3).
  EXPECT_LT((b.Inductance() * -b.I_r - b.ForceOfCurrent().transpose()).norm(),
            1e-9 * b.ForceOfCurrent().norm());
}

// A gap law of any kind: fringing flux that pulls by virtual work, like the face, and in between.
TEST_F(Bearing, DerivativesFollowAnyLawOfTheGap) {
  for (const double face_pull : {0.0, 0.4, 1.0}) {
    StatorLanes lanes = lanes_;
    lanes.reluctance.fringing = 0.2;
    lanes.reluctance.iron_path = 2e-5;
    lanes.reluctance.face_pull = face_pull;
    CheckDerivatives(lanes, UnequalCurrents(), kX, kY);
  }
}

// What a coil told 0 A cannot do: its diodes block, it carries nothing and is no state.
TEST_F(Bearing, BlockedCoilsAreLeftOut) {
  Lane current{};
  for (int j = 0; j < kPoles; ++j) current[j] = j == 3 ? 0 : 2;
  const LinearBearing b = LineariseBearing(lanes_, current, 0, 0);
  EXPECT_EQ(b.coils, (std::vector<int>{0, 1, 2, 4, 5, 6, 7}));
}

/// A bearing with iron.
class IronBearing : public ::testing::Test {
 protected:
  /// The force on the rotor when everything has settled.
  static Eigen::Vector2d SettledForce(const StatorLanes& lanes, const Lane& current, double x,
                                      double y) {
    StatorLanes at = lanes;
    at.Settle(current, x, y);
    Eigen::Vector2d f;
    at.Force(x, y, &f.x(), &f.y());
    return f;
  }
};

// Slow changes of current and place, against differences of the settled circuit.
TEST_F(IronBearing, AtRestItsDerivativesAreThoseOfTheSettledCircuit) {
  RigParameters rig = WithEffect(ReferenceRig(), "saturation", "A", {{"knee", 0.6}});
  rig = WithEffect(rig, "eddy-currents", "A", {{"cutoff", 500}});
  const Plant plant = BuildPlant(TrueRig(rig));
  const StatorLanes& lanes = plant.bearings[0].lanes;
  const Lane current = UnequalCurrents();
  const LinearBearing b = LineariseBearing(lanes, current, kX, kY);
  EXPECT_GT(b.states(), 0);
  const double di = 1e-5, h = 1e-8;
  for (int j = 0; j < kPoles; ++j) {
    Lane more = current, less = current;
    more[j] += di;
    less[j] -= di;
    const Eigen::Vector2d slope =
        (SettledForce(lanes, more, kX, kY) - SettledForce(lanes, less, kX, kY)) / (2 * di);
    EXPECT_LT((slope - b.ForceOfCurrent().col(j)).norm(), 1e-5 * b.ForceOfCurrent().norm());
  }
  for (int axis = 0; axis < 2; ++axis) {
    const double dx = axis == 0 ? h : 0, dy = axis == 1 ? h : 0;
    const Eigen::Vector2d slope = (SettledForce(lanes, current, kX + dx, kY + dy) -
                                   SettledForce(lanes, current, kX - dx, kY - dy)) /
                                  (2 * h);
    EXPECT_LT((slope - b.NegativeStiffness().col(axis)).norm(),
              1e-5 * b.NegativeStiffness().norm());
  }
  const Plant without = BuildPlant(TrueRig(ReferenceRig()));
  const LinearBearing ideal = LineariseBearing(without.bearings[0].lanes, current, kX, kY);
  EXPECT_LT(b.ForceOfCurrent().norm(), 0.99 * ideal.ForceOfCurrent().norm());
}

// A shorted turn round the flux: at constant current the flux of a small step is
// φ(t) = φ_end (1 - e^{-ω_c t}), with ω_c of the whole circuit's gap.
TEST_F(IronBearing, FluxBehindAClosedConductorFollowsAtItsCutoff) {
  RigParameters rig = ReferenceRig();
  const double cutoff = 100;  // [Hz]
  rig = WithEffect(rig, "eddy-sleeve", "Z", {{"cutoff", cutoff}});
  const Plant plant = BuildPlant(TrueRig(rig));
  const BearingPlant& thrust =
      *std::ranges::find_if(plant.bearings, [](const BearingPlant& b) { return b.thrust; });
  Lane current{};
  for (int j = 0; j < thrust.lanes.coils; ++j) current[j] = 1;
  const LinearBearing b = LineariseBearing(thrust.lanes, current, 0, 0);
  // at constant current: λ = -I_λ⁻¹ I_z z, z' = (Z_z - Z_λ I_λ⁻¹ I_z) z
  const Eigen::MatrixXd rates = b.Z_z - b.Z_lambda * b.I_lambda.inverse() * b.I_z;
  const Eigen::VectorXcd values = rates.eigenvalues();
  for (const std::complex<double>& rate : values) {
    EXPECT_NEAR(rate.real(), -2 * kPi * cutoff, 1e-3 * 2 * kPi * cutoff);
    EXPECT_NEAR(rate.imag(), 0, 1e-6);
  }
}

}  // namespace
}  // namespace ambrig
