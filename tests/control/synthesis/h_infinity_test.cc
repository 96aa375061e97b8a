/// SLICOT's H-infinity synthesis against a scalar closed form and against its own promise.
#include "control/synthesis/h_infinity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "control/synthesis/slicot.h"
#include "tests/control/unstable_mass.h"

namespace ambrig {
namespace {

using Eigen::MatrixXd;

/// Gain from w to z with u = K y: largest singular value over the frequencies.
double Norm(const StateSpace& P, const StateSpace& K, Eigen::Index controls,
            Eigen::Index measurements, int points) {
  double worst = 0;
  const Eigen::Index m = P.inputs() - controls, p = P.outputs() - measurements;
  for (int k = 0; k <= points; ++k) {
    const std::complex<double> z =
        std::polar(1.0, std::numbers::pi * std::pow(10.0, -7.0 * (points - k) / points));
    const Eigen::MatrixXcd G = P.Response(z), k_z = K.Response(z);
    const Eigen::MatrixXcd loop = Eigen::MatrixXcd::Identity(measurements, measurements) -
                                  G.bottomRightCorner(measurements, controls) * k_z;
    const Eigen::MatrixXcd T = G.topLeftCorner(p, m) + G.topRightCorner(p, controls) * k_z *
                                                           loop.inverse() *
                                                           G.bottomLeftCorner(measurements, m);
    worst = std::max(worst, Eigen::JacobiSVD<Eigen::MatrixXcd>(T).singularValues()(0));
  }
  return worst;
}

/// x+ = a x + w1 + u, z = (x, u), y = x + e w2.
StateSpace ScalarPlant(double a, double e) {
  StateSpace P;
  P.A = MatrixXd::Constant(1, 1, a);
  P.B.resize(1, 3);
  P.B << 1, 0, 1;
  P.C.resize(3, 1);
  P.C << 1, 0, 1;
  P.D = MatrixXd::Zero(3, 3);
  P.D(1, 2) = 1;
  P.D(2, 1) = e;
  return P;
}

double LeastGamma(const StateSpace& P) {
  double low = 1e-2, high = 1e3;
  for (int k = 0; k < 40; ++k) {
    const double middle = std::sqrt(low * high);
    (DiscreteHInfinity(P, 1, 1, middle).usable ? high : low) = middle;
  }
  return high;
}

// Nearly perfect measurement, x+ = a x + w + u, z = (x, u). The game's value X x² obeys X = 1 + a²
// Y/(1 + Y), Y = X/(1 - X/g²), with X < g² (Basar, Bernhard 1995, chapter 3). As X rises to g²,
// Y/(1 + Y) rises to 1: a solution exists for g² > 1 + a² only.
TEST(HInfinity, ScalarClosedForm) {
  for (const double a : {0.5, 1.0, 1.5})
    EXPECT_NEAR(LeastGamma(ScalarPlant(a, 1e-4)), std::sqrt(1 + a * a), 2e-3) << a;
}

// What was asked for is what comes out: the norm of the closed loop is below gamma, and not far
// below near the least.
TEST(HInfinity, NormIsBelowGamma) {
  const StateSpace P = ScalarPlant(1.3, 0.7);
  const double least = LeastGamma(P);
  for (const double slack : {1.01, 1.5}) {
    const HInfinityOutcome out = DiscreteHInfinity(P, 1, 1, slack * least);
    ASSERT_TRUE(out.usable);
    EXPECT_LT(Norm(P, out.controller, 1, 1, 4000), slack * least);
  }
  const HInfinityOutcome near = DiscreteHInfinity(P, 1, 1, 1.01 * least);
  EXPECT_GT(Norm(P, near.controller, 1, 1, 4000), 0.95 * least);
  EXPECT_FALSE(DiscreteHInfinity(P, 1, 1, 0.9 * least).usable);
}

TEST(HInfinity, DesignForAnUnstableMass) {
  const SampledPlant p = testing::UnstableMass();
  const HInfinityParameters w;
  const HInfinityDesign d = DesignHInfinity(p, w, "test");
  EXPECT_LT(SpectralRadius(LoopMatrix(p.FromForce(), d.controller)), 1);
  StateSpace k = d.controller;  // in the units of the weights
  k.B *= w.sensor_noise;
  k.C /= w.force_weight;
  k.D *= w.sensor_noise / w.force_weight;
  const double norm = Norm(HInfinityPlant(p, w), k, 1, 1, 4000);
  EXPECT_LT(norm, d.gamma);
  EXPECT_GT(norm, 0.5 * d.least_gamma);
  // Integral action below the bandwidth: the gain at rest is far above that at the crossover.
  EXPECT_GT(std::abs(d.controller.Response(1.0)(0, 0)),
            20 * std::abs(d.controller.Response(std::polar(1.0, 300 * p.Ts))(0, 0)));
}

}  // namespace
}  // namespace ambrig
