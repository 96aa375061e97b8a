// State feedback with an observer: the poles of the closed loop are those that were asked for.
#include "control/kinds/state_feedback.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "core/math/constants.h"

namespace ambrig {
namespace {

using Poles = std::vector<std::complex<double>>;

Poles PolesOf(const Eigen::MatrixXd& A) {
  const Eigen::VectorXcd values = A.eigenvalues();
  return {values.data(), values.data() + values.size()};
}

/// Largest distance of a wanted pole to the nearest one that is left.
double Farthest(const Poles& wanted, Poles found) {
  double worst = 0;
  for (const auto& w : wanted) {
    const auto nearest = std::min_element(found.begin(), found.end(), [&](auto a, auto b) {
      return std::abs(a - w) < std::abs(b - w);
    });
    worst = std::max(worst, std::abs(*nearest - w));
    found.erase(nearest);
  }
  return worst;
}

const StateFeedbackGains kAxisGains{4e5, 900, 0, 2.1, 1.5e5, 400, 0.8};
constexpr double kTick = 8e-5;  // [s]

// x'' = (k/m) x: the matrix is exp of [[0, 1], [k/m, 0]] Ts, its determinant 1; B = ∫ exp dt (0,
// 1/m).
TEST(StateFeedback, AxisIsSampledExactly) {
  for (const double k : {1.5e5, 0.0, -2e5}) {
    const SampledAxis s = SampleAxis(2.1, k, kTick);
    EXPECT_NEAR(s.A.determinant(), 1, 1e-13);
    Eigen::Matrix3d series = Eigen::Matrix3d::Identity(), term = series, rates;
    rates << 0, 1, 0, k / 2.1, 0, 1 / 2.1, 0, 0, 0;
    for (int n = 1; n < 12; ++n) series += term = term * rates * kTick / n;
    EXPECT_LT((s.A - series.topLeftCorner<2, 2>()).norm(), 1e-12);
    EXPECT_LT((s.B - series.topRightCorner<2, 1>()).norm(), 1e-16);
  }
}

// Separation: with the force acting one period late, the poles are those of A - B K, of the
// observer, and 0.
TEST(StateFeedback, PolesAreThoseOfTheFeedbackAndOfTheObserver) {
  const StateFeedbackGains& g = kAxisGains;
  const SampledAxis plant = SampleAxis(g.mass, g.negative_stiffness, kTick);
  const StateSpace c = StateFeedbackSystem(g, kTick);
  // States: x, v, the force under way; controller; e = -x.
  const Eigen::Index n = c.states();
  Eigen::MatrixXd loop = Eigen::MatrixXd::Zero(3 + n, 3 + n);
  loop.block<2, 2>(0, 0) = plant.A;
  loop.block<2, 1>(0, 2) = plant.B;
  loop(2, 0) = -c.D(0, 0);
  loop.block(2, 3, 1, n) = c.C;
  loop.block(3, 0, n, 1) = -c.B;
  loop.block(3, 3, n, n) = c.A;
  Poles wanted = PolesOf(plant.A - plant.B * Eigen::RowVector2d(g.kp, g.kd));
  const double omega = 2 * kPi * g.observer;
  const std::complex<double> observer =
      std::exp(kTick * omega *
               std::complex<double>(-g.observer_damping,
                                    std::sqrt(1 - g.observer_damping * g.observer_damping)));
  // The integral without a gain stays at 1; the delay is met twice, here and in the model.
  wanted.insert(wanted.end(), {observer, std::conj(observer), 1.0, 0.0, 0.0});
  EXPECT_LT(Farthest(wanted, PolesOf(loop)), 1e-6);  // 0 is double: rounding to the power 1/2
}

TEST(StateFeedback, ObserverHasItsPoles) {
  const SampledAxis plant = SampleAxis(0.06, 30, 1e-3);
  const Eigen::Vector2d L = ObserverGain(plant, 60, 0.5, 1e-3);
  Eigen::Matrix2d error = plant.A;
  error.col(0) -= L;
  const std::complex<double> pole =
      std::exp(1e-3 * 2 * kPi * 60 * std::complex<double>(-0.5, std::sqrt(0.75)));
  EXPECT_LT(Farthest({pole, std::conj(pole)}, PolesOf(error)), 1e-12);
}

}  // namespace
}  // namespace ambrig
