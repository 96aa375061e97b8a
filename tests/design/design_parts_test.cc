/// Figures of a linear loop, the Pareto front and the search against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "design/linear_figures.h"
#include "design/nlopt_search.h"
#include "design/pareto.h"

namespace ambrig {
namespace {

SampledPlant Scalar(double a) {
  SampledPlant p;
  p.A = Eigen::MatrixXd::Constant(1, 1, a);
  p.B = p.E = p.C = Eigen::MatrixXd::Constant(1, 1, 1.0);
  p.Ts = 1e-4;
  return p;
}

// P = 1/(z - a), K = -k: S = (z - a)/(z - a + k); for a > c = a - k > 0 it rises
// from (1 - a)/(1 - c) to (1 + a)/(1 + c). The force is f = -k (y + n), y a first order process:
//   var f = k² var n (1 + k²/(1 - c²))
TEST(LinearFigures, OfAScalarLoop) {
  const double a = 1.1, k = 0.6, c = a - k, noise = 0.3;
  const StateSpace K = StateSpace::Gain(Eigen::MatrixXd::Constant(1, 1, -k));
  const SampledPlant P = Scalar(a);
  const LinearFigures f = LinearFiguresOf(P, K, {noise}, 0, {0});
  EXPECT_NEAR(f.spectral_radius, c, 1e-14);
  EXPECT_NEAR(f.settling_time, -1e-4 / std::log(c), 1e-12);
  EXPECT_NEAR(f.noise_force, k * noise * std::sqrt(1 + k * k / (1 - c * c)), 1e-12);
  const std::complex<double> z = std::polar(1.0, 2 * std::numbers::pi * 2000 * 1e-4);
  EXPECT_NEAR(f.peak_sensitivity, std::abs((z - a) / (z - c)), 1e-4);  // the range's end: 2 kHz
  EXPECT_NEAR(LinearFiguresOf(P, K, {noise}, 2e4, {0}).peak_sensitivity,
              std::abs((std::polar(1.0, 2 * std::numbers::pi * 0.49) - a) /
                       (std::polar(1.0, 2 * std::numbers::pi * 0.49) - c)),
              1e-4);
  const Eigen::MatrixXd step = LoadStep(P, K, 0, 20);
  for (int n = 0; n < 20; ++n) EXPECT_NEAR(step(0, n), (1 - std::pow(c, n)) / (1 - c), 1e-12);
  EXPECT_FALSE(
      LinearFiguresOf(P, StateSpace::Gain(Eigen::MatrixXd::Constant(1, 1, -0.05)), {noise}, 0, {0})
          .stable());
}

// A narrow resonance between two grid frequencies is not missed: S = 1/(1 - P K) with poles at
// radius 0.9999.
TEST(LinearFigures, FindsANarrowPeak) {
  const double w = 0.137, r = 0.9999;
  SampledPlant p = Scalar(0);
  p.A.resize(2, 2);
  p.A << r * std::cos(w), r * std::sin(w), -r * std::sin(w), r * std::cos(w);
  p.B = p.E = Eigen::Vector2d(1, 0);
  p.C.resize(1, 2);
  p.C << 1, 0;
  const StateSpace K = StateSpace::Gain(Eigen::MatrixXd::Constant(1, 1, 1e-5));
  double peak = 0;
  for (int k = 0; k < 200000; ++k) {
    const std::complex<double> z = std::polar(1.0, 0.13 + 1e-7 * k);
    peak = std::max(peak, 1 / std::abs(1.0 - 1e-5 * p.FromForce().Response(z)(0, 0)));
  }
  EXPECT_NEAR(LinearFiguresOf(p, K, {0}, 0, {0}).peak_sensitivity, peak, 2e-3 * peak);
}

// Two modes that no force reaches, the broader one above the range of speeds: 1/(2 zeta) of the
// other, which zeta fixes exactly. A second, higher peak of S that is narrower than the grid is
// found too.
TEST(LinearFigures, AmplificationAndASecondPeak) {
  const double Ts = 1e-4;
  SampledPlant p = Scalar(0);
  p.A = Eigen::MatrixXd::Zero(4, 4);
  p.B = p.E = Eigen::MatrixXd::Zero(4, 1);
  p.C = Eigen::MatrixXd::Zero(1, 4);
  const double w[2] = {300, 900}, zeta[2] = {0.01, 0.0005};
  for (int k = 0; k < 2; ++k) {
    const double r = std::exp(-zeta[k] * w[k] * Ts),
                 turn = w[k] * std::sqrt(1 - zeta[k] * zeta[k]) * Ts;
    p.A.block(2 * k, 2 * k, 2, 2) << r * std::cos(turn), r * std::sin(turn), -r * std::sin(turn),
        r * std::cos(turn);
    p.B(2 * k, 0) = p.C(0, 2 * k) = 1;
  }
  const StateSpace none = StateSpace::Gain(Eigen::MatrixXd::Zero(1, 1)),
                   K = StateSpace::Gain(Eigen::MatrixXd::Constant(1, 1, 2e-5));
  EXPECT_NEAR(LinearFiguresOf(p, none, {0}, 0, {0}, 400).amplification, 50, 1e-6);
  EXPECT_NEAR(LinearFiguresOf(p, none, {0}, 0, {0}, 1000).amplification, 1000, 1e-5);
  EXPECT_EQ(LinearFiguresOf(p, none, {0}, 0, {0}, 200).amplification, 0);
  double peak = 0;
  for (int k = 0; k < 100000; ++k) {
    const std::complex<double> z = std::polar(1.0, 1e-6 * k + 0.01);
    peak = std::max(peak, 1 / std::abs(1.0 - 2e-5 * p.FromForce().Response(z)(0, 0)));
  }
  EXPECT_GT(peak, 1.05);
  EXPECT_NEAR(LinearFiguresOf(p, K, {0}, 0, {0}).peak_sensitivity, peak, 1e-3 * (peak - 1));
}

TEST(Pareto, FrontOfPointsByHand) {
  EXPECT_TRUE(Dominates({1, 2}, {1, 3}));
  EXPECT_FALSE(Dominates({1, 2}, {1, 2}));
  EXPECT_FALSE(Dominates({0, 4}, {1, 3}));
  const std::vector<std::vector<double>> points{{3, 1}, {1, 3},         {2, 2}, {2, 3},
                                                {2, 2}, {kInfinity, 0}, {1, 4}};
  EXPECT_EQ(ParetoFront(points), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(Compromise(points, {0, 1, 2}, {1, 1}), 2u);
  EXPECT_EQ(Compromise(points, {0, 1, 2}, {10, 1}), 0u);
}

// Every point off the front is dominated by one on it, none on it by any: for many random points in
// three dimensions.
TEST(Pareto, Property) {
  std::srand(3);
  std::vector<std::vector<double>> points;
  for (int k = 0; k < 400; ++k)
    points.push_back({std::rand() % 20 / 3.0, std::rand() % 20 / 3.0, std::rand() % 20 / 3.0});
  const auto front = ParetoFront(points);
  std::vector<bool> on(points.size(), false);
  for (const std::size_t k : front) on[k] = true;
  for (std::size_t k = 0; k < points.size(); ++k) {
    bool beaten = false;
    for (const std::size_t j : front)
      beaten = beaten || Dominates(points[j], points[k]) || (j < k && points[j] == points[k]);
    EXPECT_NE(beaten, on[k]) << k;
  }
}

TEST(NloptSearch, FindsTheLeastOfARoughFunction) {
  int count = 0;
  const auto f = [&](const std::vector<double>& x) {
    ++count;
    for (const double v : x) EXPECT_TRUE(v >= 0 && v <= 1);
    if (x[0] > 0.9) return 1e6;  // nothing works there
    return std::abs(x[0] - 0.3) + 3 * std::pow(x[1] - 0.7, 2) +
           0.5 * std::pow(x[0] + x[2] - 0.8, 2);
  };
  const auto x = SearchUnitCube(f, {0.6, 0.2, 0.1}, 400);
  EXPECT_LE(count, 400);
  EXPECT_NEAR(x[0], 0.3, 5e-3);
  EXPECT_NEAR(x[1], 0.7, 2e-2);
  EXPECT_NEAR(x[2], 0.5, 5e-2);
  EXPECT_THROW(
      SearchUnitCube([](const std::vector<double>&) -> double { throw Interrupted(); }, {0.5}, 10),
      Interrupted);
}

}  // namespace
}  // namespace ambrig
