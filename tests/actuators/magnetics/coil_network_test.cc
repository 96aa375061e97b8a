/// The witness's magnetics against the closed forms of actuators/magnetics/radial_stator.h and the
/// thrust bearing.
#include "actuators/magnetics/coil_network.h"

#include <gtest/gtest.h>

#include "rig/parameters/bearing_kind.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

constexpr double kX = 7e-5, kY = -4e-5;  // a third of the clearance off centre [m]

CoilVector SomeCurrents() {
  CoilVector i;
  i << 2.4, 1.9, 0.7, 3.1, 2.2, 1.4, 0.2, 2.9;
  return i;
}

struct Radial {
  RigParameters rig = BaseRig();
  RadialStator stator{rig.bearings[0].radial};
  CoilNetwork network{BuildPlant(TrueRig(rig)).bearings[0].lanes};
};

// λ = L i by the inductance matrix; back by the O(n) circuit: rounding of a matrix of condition 6.
TEST(CoilNetwork, InvertsTheInductanceMatrix) {
  Radial r;
  const CoilVector i = SomeCurrents(), lambda = r.stator.Inductance({kX, kY}) * i;
  NetworkState s;
  r.network.Solve(lambda.data(), kX, kY, s);
  const CoilVector phi = r.stator.Flux({kX, kY}, i);
  const Eigen::Vector2d f = r.stator.Force({kX, kY}, i);
  for (int j = 0; j < kPoles; ++j) {
    EXPECT_NEAR(s.i[static_cast<std::size_t>(j)], i[j], 1e-13);
    EXPECT_NEAR(s.phi[static_cast<std::size_t>(j)], phi[j], 1e-18);
  }
  EXPECT_NEAR(s.fx, f.x(), 1e-12 * f.norm());
  EXPECT_NEAR(s.fy, f.y(), 1e-12 * f.norm());
  double back[kMaxWindings];
  r.network.Linkages(s.i.data(), kX, kY, back);
  for (int j = 0; j < kPoles; ++j) EXPECT_NEAR(back[j], lambda[j], 1e-16);
}

// Rates are the derivative along a motion: central difference, error h²/6 of third derivatives.
TEST(CoilNetwork, RatesAreDerivatives) {
  Radial r;
  r.network.windings[6].conducts = false;  // a blocked coil carries nothing and follows the flux
  const CoilVector lambda = r.stator.Inductance({kX, kY}) * SomeCurrents();
  double slope[kPoles];
  for (int j = 0; j < kPoles; ++j) slope[j] = j == 6 ? 0 : 10 * (j - 3.5);
  const double vx = 0.01, vy = -0.02, dt = 1e-6;
  NetworkState now, before, after;
  NetworkRates rates;
  r.network.Solve(lambda.data(), kX, kY, now);
  r.network.Rates(now, slope, kX, kY, vx, vy, rates);
  const auto at = [&](double t, NetworkState& s) {
    double moved[kPoles];
    for (int j = 0; j < kPoles; ++j) moved[j] = lambda[j] + t * slope[j];
    r.network.Solve(moved, kX + t * vx, kY + t * vy, s);
  };
  at(-dt, before);
  at(dt, after);
  for (std::size_t j = 0; j < kPoles; ++j) {
    EXPECT_NEAR(rates.i[j], (after.i[j] - before.i[j]) / (2 * dt), 1e-4);  // of 1e4 A/s
    EXPECT_NEAR(rates.phi[j], (after.phi[j] - before.phi[j]) / (2 * dt), 1e-9);
  }
  EXPECT_EQ(rates.i[6], 0);
}

// Force is minus the gradient of the field energy at constant linkage.
TEST(CoilNetwork, ForceIsTheGradientOfTheFieldEnergy) {
  Radial r;
  const CoilVector lambda = r.stator.Inductance({kX, kY}) * SomeCurrents();
  const auto energy = [&](double x, double y) {
    NetworkState s;
    r.network.Solve(lambda.data(), x, y, s);
    return r.network.FieldEnergy(s, x, y);
  };
  NetworkState s;
  r.network.Solve(lambda.data(), kX, kY, s);
  const double d = 1e-8;
  EXPECT_NEAR(s.fx, -(energy(kX + d, kY) - energy(kX - d, kY)) / (2 * d), 1e-6);
  EXPECT_NEAR(s.fy, -(energy(kX, kY + d) - energy(kX, kY - d)) / (2 * d), 1e-6);
}

// phi = P N (i1 + i2), P = mu0 A/(2 g), f = phi²/(mu0 A), mutual inductance N² P.
TEST(CoilNetwork, ThrustBearingClosedForm) {
  const RigParameters rig = ReadRig(AMBRIG_SOURCE_DIR "/scenarios/library/rigs/reference.toml");
  const Plant plant = BuildPlant(TrueRig(rig));
  const std::size_t k = rig.bearings.size() - 1;
  ASSERT_TRUE(rig.bearings[k].kind->axial);
  const ThrustStatorParameters& p = rig.bearings[k].thrust;
  const CoilNetwork network(plant.bearings[k].lanes);
  const double i[4] = {1.2, 1.7, 0.9, 1.1}, z = 4e-5;
  double lambda[4], f = 0;
  network.Linkages(i, z, 0, lambda);
  for (int side = 0; side < 2; ++side) {
    const double g = p.gap + (side == 0 ? -z : z), P = kMu0 * p.pole_area / (2 * g);
    const double phi = P * p.turns * (i[2 * side] + i[2 * side + 1]);
    f += (side == 0 ? 1 : -1) * phi * phi / (kMu0 * p.pole_area);
    EXPECT_NEAR(lambda[2 * side], p.turns * phi + p.leakage_inductance * i[2 * side], 1e-15);
  }
  NetworkState s;
  network.Solve(lambda, z, 0, s);
  EXPECT_NEAR(s.fx, f, 1e-11 * std::abs(f));
  for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(s.i[j], i[j], 1e-13);
}

// A short right after the event: flux and every turn's current as before (docs/theory/base_model.md
// section 6).
TEST(CoilNetwork, AShortLeavesFluxAndTurnCurrentsContinuous) {
  Radial r;
  const int loop = static_cast<int>(r.network.ReserveLoop(2));
  double lambda[kMaxWindings] = {};
  const CoilVector i = SomeCurrents(), full = r.stator.Inductance({kX, kY}) * i;
  std::copy(full.data(), full.data() + kPoles, lambda);
  NetworkState before, after;
  r.network.Solve(lambda, kX, kY, before);
  r.network.Short(2, loop, 0.3, 0.05, before, lambda);
  r.network.Solve(lambda, kX, kY, after);
  for (std::size_t j = 0; j < kPoles; ++j) EXPECT_NEAR(after.i[j], i[static_cast<int>(j)], 1e-12);
  EXPECT_NEAR(after.i[static_cast<std::size_t>(loop)], i[2], 1e-12);
  for (std::size_t j = 0; j < kPoles; ++j) EXPECT_NEAR(after.phi[j], before.phi[j], 1e-17);
  EXPECT_DOUBLE_EQ(r.network.windings[static_cast<std::size_t>(loop)].resistance, 0.3 * 0.5 + 0.05);
}

}  // namespace
}  // namespace ambrig
