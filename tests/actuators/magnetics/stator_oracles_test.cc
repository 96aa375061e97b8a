// k_i and k_s of stators of the literature's kinds, with one set of dimensions: the network against
// closed forms to 1e-9, and against numbers that were computed independently by central differences
// (all digits given).
#include <gtest/gtest.h>

#include <cmath>

#include "actuators/magnetics/pole_network.h"
#include "actuators/magnetics/stator_parameters.h"
#include "core/math/constants.h"

namespace ambrig {
namespace {

constexpr double kFace = 2e-4, kAir = 4e-4, kWound = 100, kCurrent = 2;  // [m2], [m], -, [A]
const double kField = kMu0 * kWound * kCurrent / kAir;                   // [T]

struct StatorOracle {
  const char *name, *pattern, *winding, *coils;
  int poles;
  double cone_deg;
  double ki, ki_digits, ks, ks_digits;  // published, and half of their last digit
  double ki_closed, ks_closed;
};

/// Sum over a quadrant of cos of evenly spaced poles, half a pitch off the axis.
double QuadrantCosines(int poles) {
  double sum = 0;
  for (int k = 0; k < poles / 4; ++k) sum += std::cos((k + 0.5 - poles / 8.0) * 2 * kPi / poles);
  return sum;
}

double PairsGain(int poles) {
  return 2 * kFace * kField * kField / (kMu0 * kCurrent) * QuadrantCosines(poles);
}
double PairsStiffness(int poles) { return poles * kFace * kField * kField / (2 * kMu0 * kAir); }

/// A magnet of 800 A, 4 mm, 6 cm2, mu_r 1.05 in series with two rows of four gaps.
double HomopolarField() {
  return 800 / (4e-3 / (kMu0 * 1.05 * 6e-4) + 2 * kAir / (kMu0 * 4 * kFace)) / (4 * kFace);
}

std::vector<StatorOracle> Oracles() {
  const double c = std::cos(10 * kPi / 180), B0 = HomopolarField();
  // E-cores: centre poles of twice the area; of equal polarity half of their MMF is lost in the
  // outer ones.
  const double core = 4 * kFace * kField * kField / kMu0;
  return {
      {"Pairs8", "series-pairs", "NS", "", 8, 0, 116.0981, 5e-5, 628318.5, 0.05, PairsGain(8),
       PairsStiffness(8)},
      {"Pairs8Equal", "series-pairs", "NNSS", "", 8, 0, 116.0981, 5e-5, 628318.5, 0.05,
       PairsGain(8), PairsStiffness(8)},
      {"Pairs16", "series-pairs", "NS", "", 16, 0, 227.7347, 5e-5, 1256637, 0.5, PairsGain(16),
       PairsStiffness(16)},
      {"Pairs24", "series-pairs", "NS", "", 24, 0, 340.3825, 5e-5, 1884956, 0.5, PairsGain(24),
       PairsStiffness(24)},
      {"CoresEqual", "e-core", "N", "", 0, 0, 62.8319, 5e-5, 314159, 0.5, core / kCurrent / 2,
       core / kAir / 2},
      {"Cores", "e-core", "NS", "", 0, 0, 125.6637, 5e-5, 628319, 0.5, core / kCurrent,
       core / kAir},
      {"Homopolar", "homopolar-pm", "", "axis", 4, 0, 34.1979, 5e-5, 46532.8, 0.05,
       4 * kFace * B0 * kWound / kAir, 4 * kFace * B0 * B0 / (kMu0 * kAir)},
      {"Axial", "axial", "", "", 0, 0, 31.4159, 5e-5, 157079.6, 0.05,
       kMu0 * kWound * kWound * kFace * kCurrent / (kAir * kAir),
       kMu0 * kWound * kWound * kFace * kCurrent * kCurrent / (kAir * kAir * kAir)},
      {"Cone", "conical", "NS", "", 8, 10, 114.3343, 5e-5, 609372, 0.5, c * PairsGain(8),
       c * c * PairsStiffness(8)},
  };
}

StatorParameters StatorOfOracle(const StatorOracle& o) {
  StatorParameters p;
  p.pattern = o.pattern;
  p.axial = FindStatorTemplate(o.pattern)->axial;
  p.winding = o.winding;
  p.connection = o.coils;
  p.pole_count = o.poles;
  p.cone_deg = o.cone_deg;
  p.turns = kWound;
  p.pole_area = kFace;
  p.gap = kAir;
  p.leakage_inductance = 1e-3;
  p.resistance = 1;
  if (p.pattern == "homopolar-pm") p.bias = {800, 4e-3, 6e-4, 1.05};
  return p;
}

/// The coils of +x and -x (axial: of the two sides; a coil of both in series) carry i0 + i and i0
/// - i.
Eigen::VectorXd DifferentialOf(const PoleNetwork& network) {
  const auto n = network.coils();
  if (n == 2 && network.has_magnets()) return Eigen::Vector2d(1, 0);
  if (n == 2) return Eigen::Vector2d(1, -1);
  return Eigen::Vector4d(1, 0, -1, 0);
}

class StatorOracles : public ::testing::TestWithParam<StatorOracle> {};

TEST_P(StatorOracles, GainAndNegativeStiffness) {
  const StatorOracle& o = GetParam();
  const auto network = NetworkOf(StatorOfOracle(o));
  const Eigen::VectorXd drive = DifferentialOf(*network);
  const Eigen::VectorXd bias =
      Eigen::VectorXd::Constant(network->coils(), network->has_magnets() ? 0 : kCurrent);
  const double ki = (network->ForceOfCurrent(Eigen::Vector3d::Zero(), bias) * drive)[0];
  const double ks = network->NegativeStiffness(Eigen::Vector3d::Zero(), bias)(0, 0);
  EXPECT_NEAR(ki, o.ki_closed, 1e-9 * o.ki_closed);
  EXPECT_NEAR(ks, o.ks_closed, 1e-9 * o.ks_closed);
  EXPECT_NEAR(ki, o.ki, o.ki_digits);
  EXPECT_NEAR(ks, o.ks, o.ks_digits);
  // Central differences of the forces, as the numbers were made: force is quadratic in the
  // currents, so that only rounding is left of the first; (dx/g)² of the second.
  const double di = 1e-4, dx = 1e-8;
  const auto force = [&](double x, double i) {
    return network->Force({x, 0, 0}, bias + i * drive).x();
  };
  EXPECT_NEAR((force(0, di) - force(0, -di)) / (2 * di), ki, 1e-9 * ki);
  EXPECT_NEAR((force(dx, 0) - force(-dx, 0)) / (2 * dx), ks, 1e-6 * ks);
}

INSTANTIATE_TEST_SUITE_P(Table, StatorOracles, ::testing::ValuesIn(Oracles()),
                         [](const auto& p) { return std::string(p.param.name); });

TEST(StatorOraclesBiased, OnlyOnePairAndAConeAlongTheShaft) {
  StatorOracle o = Oracles()[0];
  const auto pairs = NetworkOf(StatorOfOracle(o));
  const double along = std::cos(22.5 * kPi / 180) * std::cos(22.5 * kPi / 180);
  const double ks = pairs->NegativeStiffness(Eigen::Vector3d::Zero(),
                                             Eigen::Vector4d(kCurrent, 0, kCurrent, 0))(0, 0);
  EXPECT_NEAR(ks, PairsStiffness(8) * along, 1e-9 * ks);
  EXPECT_NEAR(ks, 536303.4, 0.05);
  o = Oracles().back();
  const auto cone = NetworkOf(StatorOfOracle(o));
  const Eigen::Vector4d bias = Eigen::Vector4d::Constant(kCurrent);
  const double pull = cone->Force(Eigen::Vector3d::Zero(), bias).z();
  const double sine = std::sin(10 * kPi / 180);
  EXPECT_NEAR(pull, 8 * kFace * kField * kField / (2 * kMu0) * sine, 1e-9 * pull);
  EXPECT_NEAR(pull, 43.6425, 5e-5);
  const double kz = cone->NegativeStiffness(Eigen::Vector3d::Zero(), bias)(2, 2);
  EXPECT_NEAR(kz, 2 * pull * sine / kAir, 1e-9 * kz);
  EXPECT_NEAR(kz, 37892, 0.5);
}

}  // namespace
}  // namespace ambrig
