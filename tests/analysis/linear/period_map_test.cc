// One switching period of the linear plant against the exact flow and against edges that really
// move.
#include "analysis/linear/period_map.h"

#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>

#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct OnePeriod {
  OperatingPoint point;
  LinearPlant plant;
  PeriodMap map;
  explicit OnePeriod(const RigParameters& rig, double speed = 300)
      : point(FindOperatingPoint(rig)),
        plant(LinearisePlant(point, speed)),
        map(MakePeriodMap(point, plant)) {}
};

RigParameters Modulated(Modulation m) {
  RigParameters rig = ReferenceRig();
  rig.amplifier.modulation = m;
  return rig;
}

/// States over their usual sizes: metres, metres per second, webers, so that errors are compared
/// alike.
MatrixXd ScaledRows(const OnePeriod& p, MatrixXd rows) {
  const Index m = p.plant.m();
  rows.topRows(m) /= 1e-5;
  rows.middleRows(m, m) /= 1e-2;
  rows.bottomRows(rows.rows() - 2 * m) /= 1e-2;
  return rows;
}

TEST(PeriodMap, OfTheStateIsTheExponential) {
  const OnePeriod p(ReferenceRig());
  const MatrixXd exact = (p.plant.A * p.map.T).exp();
  EXPECT_DOUBLE_EQ(p.map.T, 40e-6);
  EXPECT_EQ(p.map.samples, 18);
  EXPECT_LT((p.map.state - exact).norm(), 1e-10 * exact.norm());
}

// A constant rate: A ∫ e^{As} ds = e^{AT} - 1.
TEST(PeriodMap, OfAPushSolvesTheEquationOfMotion) {
  const OnePeriod p(ReferenceRig());
  const MatrixXd left = p.plant.A * p.map.push,
                 right =
                     (p.map.state - MatrixXd::Identity(p.plant.n(), p.plant.n())) * p.plant.pushed;
  EXPECT_LT((left - right).norm(), 1e-8 * right.norm());
}

/// x(T) and mean of the samples from rest with a voltage on coil j, `up` until `edge`, `down` after
/// it.
std::pair<VectorXd, VectorXd> Driven(const OnePeriod& p, Index j, double edge, double up,
                                     double down) {
  const Index n = p.plant.n();
  const double h = p.map.T / p.map.samples;
  // [x, v]' = [A e_j; 0 0] [x, v]
  MatrixXd augmented = MatrixXd::Zero(n + 1, n + 1);
  augmented.topLeftCorner(n, n) = p.plant.A;
  augmented(2 * p.plant.m() + j, n) = 1;
  const auto flow = [&](VectorXd x, double v, double dt) -> VectorXd {
    VectorXd z(n + 1);
    z << x, v;
    return ((augmented * dt).exp() * z).head(n);
  };
  VectorXd x = VectorXd::Zero(n), mean = VectorXd::Zero(p.plant.current.rows());
  for (int k = 0; k < p.map.samples; ++k) {
    mean += p.plant.current * x / p.map.samples;
    const double on = std::clamp(edge - k * h, 0.0, h);
    if (on > 0) x = flow(x, up, on);
    if (on < h) x = flow(x, down, h - on);
  }
  return {x, mean};
}

// The edge a little later and a little earlier: half the difference over the change of duty.
TEST(PeriodMap, OfADutyIsTheMovedEdge) {
  const OnePeriod p(ReferenceRig());
  const AmplifierParameters& a = p.point.rig().amplifier;
  const double up = a.bus_voltage - 2 * a.switch_drop, down = -a.bus_voltage - 2 * a.diode_drop;
  for (const Index j : {Index{0}, Index{5}, Index{13}}) {
    const PlantCoil& coil = p.plant.coils[static_cast<std::size_t>(j)];
    const double duty = p.point.coils[coil.bearing][static_cast<std::size_t>(coil.lane)].duty;
    const double step = 1e-4;
    const auto [late, late_mean] = Driven(p, j, (duty + step) * p.map.T, up, down);
    const auto [early, early_mean] = Driven(p, j, (duty - step) * p.map.T, up, down);
    const VectorXd moved = (late - early) / (2 * step),
                   read = (late_mean - early_mean) / (2 * step);
    EXPECT_LT(ScaledRows(p, p.map.duty.col(j) - moved).norm(), 1e-4 * ScaledRows(p, moved).norm())
        << j;
    EXPECT_LT((p.map.feedback_of_duty.col(j) - read).norm(), 1e-4 * read.norm()) << j;
  }
}

// An ideal amplifier gives duty times bus over the whole period.
TEST(PeriodMap, OfAnIdealAmplifierIsAStepOfVoltage) {
  const OnePeriod p(Modulated(Modulation::kIdeal));
  const auto [x, mean] = Driven(p, 3, p.map.T, p.point.plant().bus.voltage, 0);
  EXPECT_LT(ScaledRows(p, p.map.duty.col(3) - x).norm(), 1e-9 * ScaledRows(p, x).norm());
  EXPECT_LT((p.map.feedback_of_duty.col(3) - mean).norm(), 1e-9 * mean.norm());
}

// The mean of the samples of a state that hardly changes within a period is its current.
TEST(PeriodMap, FeedbackOfTheStateIsTheMeanOfItsSamples) {
  const OnePeriod p(ReferenceRig());
  MatrixXd mean = MatrixXd::Zero(p.plant.current.rows(), p.plant.n());
  for (int k = 0; k < p.map.samples; ++k)
    mean += p.plant.current * MatrixXd((p.plant.A * (k * p.map.T / p.map.samples)).exp()) /
            p.map.samples;
  EXPECT_LT((p.map.feedback_of_state - mean).norm(), 1e-10 * mean.norm());
}

}  // namespace
}  // namespace ambrig
