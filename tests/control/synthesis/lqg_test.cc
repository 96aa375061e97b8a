/// Riccati equations and LQG against closed forms and their own definitions.
#include "control/synthesis/lqg.h"

#include <gtest/gtest.h>

#include <cmath>

#include "control/synthesis/riccati.h"
#include "tests/control/unstable_mass.h"

namespace ambrig {
namespace {

using Eigen::MatrixXd;

MatrixXd Scalar(double v) { return MatrixXd::Constant(1, 1, v); }

// x+ = a x + b u, cost q x² + r u²: b² X² + (r - a² r - q b²) X - q r = 0.
TEST(Riccati, ScalarClosedForm) {
  for (const double a : {0.5, 1.0, 1.3, 3.0})
    for (const double q : {1e-3, 10.0}) {
      const double b = 0.7, r = 2, c = r - a * a * r - q * b * b;
      const double X = (-c + std::sqrt(c * c + 4 * b * b * q * r)) / (2 * b * b);
      const RiccatiSolution s = SolveRiccati(Scalar(a), Scalar(b), Scalar(q), Scalar(r));
      EXPECT_NEAR(s.X(0, 0), X, 1e-10 * X) << a << ' ' << q;
      EXPECT_NEAR(s.K(0, 0), a * b * X / (r + b * b * X), 1e-10);
      EXPECT_LT(s.spectral_radius, 1);
    }
}

// Double integrator, unstable oscillator: the equation's residual, and a stable loop.
TEST(Riccati, ResidualOfLargerOnes) {
  std::srand(7);
  for (const int n : {2, 5, 12}) {
    const MatrixXd A = MatrixXd::Identity(n, n) + 0.4 * MatrixXd::Random(n, n),
                   B = MatrixXd::Random(n, 2), C = MatrixXd::Random(3, n);
    const RiccatiSolution s = SolveRiccati(A, B, C.transpose() * C, MatrixXd::Identity(2, 2));
    EXPECT_LT(s.residual, 1e-9);
    EXPECT_LT(s.spectral_radius, 1);
    EXPECT_GT(SpectralRadius(A), 1);  // there was something to stabilise
  }
}

TEST(Riccati, SaysWhenThereIsNoSolution) {
  MatrixXd A = MatrixXd::Identity(2, 2), B(2, 1);
  A(1, 1) = 1.2;
  B << 1, 0;  // the unstable state is out of reach
  EXPECT_FALSE(SolveRiccati(A, B, MatrixXd::Identity(2, 2), Scalar(1)).usable());
}

// Separation: the loop's poles are those of A - B K and of A - A L C, which the design promises to
// be stable.
TEST(Lqg, LoopIsStableByTheSeparationTheorem) {
  const SampledPlant p = testing::UnstableMass();
  const LqgDesign d = DesignLqg(p, {}, "test");
  const LqgController k({0}, {d}, {100}, p.Ts);
  EXPECT_LT(d.control_residual, 1e-9);
  EXPECT_LT(d.filter_residual, 1e-9);
  EXPECT_NEAR(SpectralRadius(LoopMatrix(p.FromForce(), k.Linear(0))), d.spectral_radius, 1e-8);
  EXPECT_LT(d.spectral_radius, 1);
}

// Against the plant: a step of load is integrated away, a reference is reached, both without being
// told.
TEST(Lqg, RejectsALoadAndFollowsAReference) {
  const SampledPlant p = testing::UnstableMass();
  LqgController k({0}, {DesignLqg(p, {}, "test")}, {1000}, p.Ts);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(3);
  std::vector<double> f(1);
  double worst = 0;
  for (int n = 0; n < 20000; ++n) {
    const double y = (p.C * x)(0), r = n >= 10000 ? 5e-6 : 0;
    k.Step({y}, {r}, {0}, 0, f);
    x = (p.A * x + p.B * f[0] + p.E * 30).eval();
    if (n < 10000) worst = std::max(worst, std::abs(y));
    if (n == 9999) {
      EXPECT_LT(std::abs(y), 1e-9);
    }
  }
  EXPECT_NEAR((p.C * x)(0), 5e-6, 1e-9);
  EXPECT_GT(worst, 1e-6);  // there was a disturbance
}

// Held on a force while the shaft stands off the model's rest, the first steps ask for that force.
TEST(Lqg, HoldAndLinear) {
  const SampledPlant p = testing::UnstableMass();
  LqgController k({0}, {DesignLqg(p, {}, "test")}, {1000}, p.Ts);
  std::vector<double> f(1);
  k.Hold({25}, {2e-6}, {2e-6});
  for (int n = 0; n < 20; ++n) {
    k.Step({2e-6}, {2e-6}, {0}, 0, f);
    EXPECT_NEAR(f[0], 25, 1e-7) << n;
  }
  k.Hold({0}, {0}, {0});
  const StateSpace s = k.Linear(0);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(s.states());
  for (int n = 0; n < 100; ++n) {
    const double y = 1e-6 * std::sin(0.2 * n);
    k.Step({y}, {0}, {0}, 0, f);
    EXPECT_NEAR(f[0], (s.C * x)(0) + s.D(0, 0) * y, 1e-8 * (1 + std::abs(f[0]))) << n;
    x = (s.A * x + s.B * y).eval();
  }
}

TEST(Lqg, SaysWhatCannotBeHeld) {
  SampledPlant p = testing::UnstableMass();
  p.B.setZero();
  try {
    DesignLqg(p, {}, "rig.toml:7: controller.kind");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_TRUE(
        std::string(e.what()).starts_with("rig.toml:7: controller.kind: no stabilising solution"))
        << e.what();
  }
}

}  // namespace
}  // namespace ambrig
