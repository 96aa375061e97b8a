/// The magnetic circuit of the lanes against closed forms: inductances, flux balance, force as the
/// gradient of the co-energy, force constants of docs/theory/published_values.md 1, 2.1.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "actuators/magnetics/radial_stator.h"
#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

constexpr double kCircuitX = 7e-5, kCircuitY = -4e-5;  // a third of the clearance off centre [m]
// N² mu0 A / g0 of the reference rig, five digits of its area [H]
constexpr double kL0 = 1.6e-3;

Lane CircuitCurrents() { return {{2.4, 1.9, 0.7, 3.1, 2.2, 1.4, 0.2, 2.9}}; }

/// Column j of the inductance matrix, from the lanes: linkages of one ampere in coil j.
CoilMatrix InductanceOf(StatorLanes& lanes, double x, double y) {
  CoilMatrix L;
  for (int j = 0; j < kPoles; ++j) {
    Lane one;
    one[j] = 1;
    lanes.Settle(one, x, y);
    for (int k = 0; k < kPoles; ++k) L(k, j) = lanes.lambda[k];
  }
  return L;
}

// Two derivations: poles with a common node, and the matrix N² S (P - P 1 1ᵀ P / 1ᵀP1) S + L_l I.
TEST(MagneticCircuit, LanesCarryTheInductanceMatrix) {
  StatorLanes lanes = LanesOf("A");
  const CoilMatrix expected =
      RadialStator(ReferenceLanesRig().bearings[0].radial).Inductance({kCircuitX, kCircuitY});
  EXPECT_LT((InductanceOf(lanes, kCircuitX, kCircuitY) - expected).norm(),
            1e-15 * expected.norm() * 8);
}

// base_model.md section 2: 1.75 mH a coil; seven patterns see 1.95 mH, the flux-free one 0.35 mH.
TEST(MagneticCircuit, ReferenceInductances) {
  StatorLanes lanes = LanesOf("A");
  const CoilMatrix L = InductanceOf(lanes, 0, 0);
  EXPECT_NEAR(L(0, 0), 1.75e-3, 1e-7);
  const Eigen::SelfAdjointEigenSolver<CoilMatrix> eigen(L);
  EXPECT_NEAR(eigen.eigenvalues()[0], 0.35e-3, 1e-9);
  for (int k = 1; k < kPoles; ++k) EXPECT_NEAR(eigen.eigenvalues()[k], 1.95e-3, 1e-7);
  const CoilVector flux_free = eigen.eigenvectors().col(0) * std::sqrt(8.0);  // s_j i_j all equal
  for (int k = 1; k < kPoles; ++k)
    EXPECT_NEAR(flux_free[k] * flux_free[0], k % 2 == 0 ? 1 : -1, 1e-9);
}

struct GapRow {
  double x, near, far, mutual;  // x/g0, then in units of mu0 N² A/g0
};
void PrintTo(const GapRow& row, std::ostream* out) { *out << row.x << " gaps off centre"; }
class PublishedGaps : public ::testing::TestWithParam<GapRow> {};

// docs/theory/published_values.md 1.1: rotor moved towards pole 1. Four digits printed.
TEST_P(PublishedGaps, SelfAndMutualInductance) {
  RadialStatorParameters p = ReferenceLanesRig().bearings[0].radial;
  p.first_pole_angle_deg = 0;
  const double unit = p.turns * p.turns * kMu0 * p.pole_area / p.gap;
  const auto [x, near, far, mutual] = GetParam();
  const CoilMatrix L = RadialStator(p).Inductance({x * p.gap, 0});
  EXPECT_NEAR((L(0, 0) - p.leakage_inductance) / unit, near, 5e-5);
  EXPECT_NEAR((L(4, 4) - p.leakage_inductance) / unit, far, 5e-5);
  EXPECT_NEAR(-std::abs(L(0, 1)) / unit, mutual, 5e-5);
}
INSTANTIATE_TEST_SUITE_P(Facts, PublishedGaps,
                         ::testing::Values(GapRow{0, 0.8750, 0.8750, -0.1250},
                                           GapRow{0.1, 0.9576, 0.8063, -0.1487},
                                           GapRow{0.2, 1.0586, 0.7483, -0.1783},
                                           GapRow{0.3, 1.1852, 0.6987, -0.2162},
                                           GapRow{0.5, 1.5670, 0.6186, -0.3349}));

class EveryStator : public ::testing::TestWithParam<std::string> {
 protected:
  StatorLanes lanes_ = LanesOf(GetParam());
  bool radial() const { return GetParam() != "Z"; }
  double y() const { return radial() ? kCircuitY : 0; }
};

// At fixed currents of a linear circuit co-energy = field energy: F = +dW'/dx. Central difference
// with h = 1e-7 m: error h²/6 of a third derivative 6 W/g³, 1e-7 of F.
TEST_P(EveryStator, ForceIsTheGradientOfTheCoenergy) {
  const auto coenergy = [&](double x, double y) {
    lanes_.Settle(CircuitCurrents(), x, y);
    return lanes_.FieldEnergy(x, y);
  };
  const double h = 1e-7;
  const double fx = (coenergy(kCircuitX + h, y()) - coenergy(kCircuitX - h, y())) / (2 * h);
  const double fy = (coenergy(kCircuitX, y() + h) - coenergy(kCircuitX, y() - h)) / (2 * h);
  lanes_.Settle(CircuitCurrents(), kCircuitX, y());
  double force_x, force_y;
  lanes_.Force(kCircuitX, y(), &force_x, &force_y);
  EXPECT_GT(std::abs(fx), 1);
  EXPECT_NEAR(force_x, fx, 1e-6 * std::abs(fx));
  EXPECT_NEAR(force_y, fy, 1e-6 * std::abs(fx));
}

// At fixed linkages nothing comes from the amplifiers: F = -dW/dx. The currents follow by Refresh.
TEST_P(EveryStator, ForceIsTheLossOfFieldEnergyAtFixedLinkages) {
  lanes_.Settle(CircuitCurrents(), kCircuitX, y());
  double force_x, force_y;
  lanes_.Force(kCircuitX, y(), &force_x, &force_y);
  const StatorLanes settled = lanes_;
  const auto energy = [&](double x) {
    lanes_ = settled;
    lanes_.Refresh(x, y());
    return lanes_.FieldEnergy(x, y());
  };
  const double h = 1e-7;
  EXPECT_NEAR(force_x, -(energy(kCircuitX + h) - energy(kCircuitX - h)) / (2 * h),
              1e-6 * std::abs(force_x));
}

// Fringing and a reluctance of the iron change the law of the gap; its slope must follow.
TEST_P(EveryStator, ForceFollowsAnyLawOfTheGap) {
  lanes_.reluctance.fringing = 0.3;
  lanes_.reluctance.iron_path = 3e-5;
  const double h = 1e-7;
  double energy[2], force_x, force_y;
  for (int k = 0; k < 2; ++k) {
    const double x = kCircuitX + (k == 0 ? -h : h);
    lanes_.Settle(CircuitCurrents(), x, y());
    energy[k] = lanes_.FieldEnergy(x, y());
  }
  lanes_.Settle(CircuitCurrents(), kCircuitX, y());
  lanes_.Force(kCircuitX, y(), &force_x, &force_y);
  EXPECT_NEAR(force_x, (energy[1] - energy[0]) / (2 * h), 1e-6 * std::abs(force_x));
}

// Σ phi = 0 over the poles; both windings of a thrust core see one flux. Also while it switches.
TEST_P(EveryStator, FluxBalances) {
  lanes_.Settle(CircuitCurrents(), kCircuitX, y());
  Lane volts;
  for (int j = 0; j < lanes_.coils; ++j) volts[j] = j % 3 == 0 ? 29.75 : 5.0 * (j - 4);
  lanes_.BeginPeriod(kCircuitX, y(), kCircuitX + 2e-6, y(), 18);
  for (int k = 0; k < 18; ++k) {
    lanes_.StepSample(Constant(volts), 30, k);
    double sum = 0, size = 0;
    for (int j = 0; j < lanes_.coils; ++j) {
      sum += lanes_.phi[j];
      size += std::abs(lanes_.phi[j]);
    }
    if (radial()) {
      EXPECT_LT(std::abs(sum), 1e-14 * size) << k;
    } else {
      EXPECT_EQ(lanes_.phi[0], lanes_.phi[1]);
      EXPECT_EQ(lanes_.phi[2], lanes_.phi[3]);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Reference, EveryStator, ::testing::Values("A", "Z"),
                         [](const auto& p) { return p.param; });

// docs/theory/base_model.md section 2: f = phi²/(mu0 A) a side, phi = mu0 A N (i1 + i2)/(2 g).
TEST(MagneticCircuit, ThrustForceClosedForm) {
  StatorLanes lanes = LanesOf("Z");
  const ThrustStatorParameters& p = ReferenceLanesRig().Find("Z")->thrust;
  const double z = 6e-5;
  lanes.Settle({{1.8, 1.4, 1.1, 0.9}}, z, 0);
  const auto pull = [&](double amperes, double gap) {
    const double phi = kMu0 * p.pole_area * p.turns * amperes / (2 * gap);
    return phi * phi / (kMu0 * p.pole_area);
  };
  double f, none;
  lanes.Force(z, 0, &f, &none);
  EXPECT_NEAR(f, pull(3.2, p.gap - z) - pull(2.0, p.gap + z), 1e-12 * f);
}

// published_values.md 2.1: F = 4 kappa c0 v, k_i = 4 kappa c0, k_s = 4 kappa c0²/g0,
// hence k_i/k_s = g0/c0. The reference rig: kappa 4 N/A², k_i 32 N/A, k_s 1.6e5 N/m
// (published_values.md 2.3), 144 N with 6 A (1.6 too).
TEST(MagneticCircuit, ForceConstantAndNegativeStiffnessOfTheHealthyBearing) {
  StatorLanes lanes = LanesOf("A");
  const double c0 = 2, kappa = kL0 / 4e-4;
  const auto force = [&](double x, double vx, double vy, double bias) {
    Lane i;
    for (int j = 0; j < kPoles; ++j)
      i[j] = bias + vx * lanes.direction_x[j] + vy * lanes.direction_y[j];
    lanes.Settle(i, x, 0);
    Eigen::Vector2d f;
    lanes.Force(x, 0, &f.x(), &f.y());
    return f;
  };
  for (double v : {0.01, 0.5, 1.9}) {  // exactly linear while every current is positive
    const Eigen::Vector2d f = force(0, v, -0.3 * v, c0);
    EXPECT_NEAR(f.x(), 4 * kappa * c0 * v, 1e-4 * f.x());
    EXPECT_NEAR(f.y(), -0.3 * f.x(), 1e-12);
  }
  const double h = 1e-7, ks = (force(h, 0, 0, c0).x() - force(-h, 0, 0, c0).x()) / (2 * h);
  EXPECT_NEAR(ks, 1.6e5, 1e-4 * ks);
  const double ki = force(0, 1, 0, c0).x();
  EXPECT_NEAR(ki, 32, 1e-4 * ki);
  EXPECT_NEAR(ki / ks, 4e-4 / c0, 1e-6 * ki / ks);
  EXPECT_NEAR(force(0, 3, 0, 3).x(), 144, 0.02);
  EXPECT_NEAR(RadialStator(ReferenceLanesRig().bearings[0].radial).ForceConstant() * c0, ki,
              1e-12 * ki);
}

// published_values.md 2.1: subtracting one coil's current from all of them changes no flux,
// anywhere.
TEST(MagneticCircuit, TheFluxFreePatternCarriesNoForce) {
  StatorLanes lanes = LanesOf("A");
  lanes.unipolar = false;
  lanes.Settle(CircuitCurrents(), kCircuitX, kCircuitY);
  const Lane phi = lanes.phi;
  Lane shifted = CircuitCurrents();
  // NSNSNSNS
  for (int j = 0; j < kPoles; ++j) shifted[j] -= (j % 2 == 0 ? 1 : -1) * CircuitCurrents()[2];
  lanes.Settle(shifted, kCircuitX, kCircuitY);
  EXPECT_EQ(lanes.i[2], 0);
  for (int j = 0; j < kPoles; ++j) EXPECT_NEAR(lanes.phi[j], phi[j], 1e-19);
}

}  // namespace
}  // namespace ambrig
