// Joint margins against closed forms, against every phase tried, and against the poles of a changed
// loop.
#include "analysis/disk_margin.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <complex>
#include <random>
#include <vector>

#include "analysis/sensitivity.h"
#include "analysis/structured_singular_value.h"
#include "core/math/constants.h"
#include "rig/rig_file.h"
#include "tests/cli/cli_run.h"

extern "C" void ab13md_(const char* fact, const int* n, std::complex<double>* z, const int* ldz,
                        const int* m, const int* nblock, const int* itype, double* x, double* bound,
                        double* d, double* g, int* iwork, double* dwork, const int* ldwork,
                        std::complex<double>* zwork, const int* lzwork, int* info, int);

namespace ambrig {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;

MatrixXcd Matrix(int n, std::mt19937& random) {
  std::normal_distribution<double> normal;
  MatrixXcd M(n, n);
  for (Complex& m : M.reshaped()) m = {normal(random), normal(random)};
  return M;
}

// A rank of one: det(I - u v^H Δ) = 1 - Σ δ_i u_i conj(v_i), so μ = Σ |u_i v_i|.
TEST(StructuredSingularValue, OfRankOne) {
  std::mt19937 random(7);
  for (int n : {2, 3, 5}) {
    const MatrixXcd u = Matrix(n, random).col(0), v = Matrix(n, random).col(0);
    const MatrixXcd M = u * v.adjoint();
    const double mu = (u.array() * v.array()).abs().sum();
    EXPECT_NEAR(LeastUpperBound(M).value / mu, 1, 2e-4) << n;
    EXPECT_GE(LeastUpperBound(M).value, mu * (1 - 1e-12));
    EXPECT_NEAR(LargestLowerBound(M).value / mu, 1, 1e-9) << n;
  }
}

// Two loops that only move each other: 1 - δ_1 δ_2 b c = 0, whatever the ratio of b to c.
TEST(StructuredSingularValue, OfTwoCrossedLoops) {
  MatrixXcd M = MatrixXcd::Zero(2, 2);
  M(0, 1) = Complex(0, 50);
  M(1, 0) = -0.02;
  EXPECT_NEAR(LeastUpperBound(M).value, 1, 1e-3);
  EXPECT_NEAR(LargestLowerBound(M).value, 1, 1e-9);
  // one way only: no Δ closes a loop; the bound goes to 0 with the reach of the scaling
  M(1, 0) = 0;
  EXPECT_LT(LeastUpperBound(M).value, 1e-3);
}

// Up to three scalars the least bound is μ: all phases tried in steps of four degrees.
TEST(StructuredSingularValue, OfThreeLoopsIsTheWorstOfAllPhases) {
  std::mt19937 random(3);
  for (int example = 0; example < 3; ++example) {
    const MatrixXcd M = Matrix(3, random);
    double mu = 0;
    for (int a = 0; a < 90; ++a)
      for (int b = 0; b < 90; ++b) {
        Eigen::Vector3cd q(1, std::polar(1.0, a * kPi / 45), std::polar(1.0, b * kPi / 45));
        mu = std::max(mu, Eigen::ComplexEigenSolver<MatrixXcd>(M * q.asDiagonal(), false)
                              .eigenvalues()
                              .cwiseAbs()
                              .maxCoeff());
      }
    const double upper = LeastUpperBound(M).value;
    EXPECT_GE(upper, mu * (1 - 1e-12));
    EXPECT_NEAR(upper / mu, 1, 2e-3);
    const MuLower lower = LargestLowerBound(M);
    EXPECT_LE(lower.value, upper * (1 + 1e-9));
    EXPECT_GE(lower.value, 0.9 * upper);
    const MatrixXcd loop = MatrixXcd::Identity(3, 3) - M * lower.delta.asDiagonal();
    EXPECT_LT(std::abs(loop.determinant()), 1e-9);
  }
}

TEST(StructuredSingularValue, TheBoundIsTheLeastOfManyScalings) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0, 1.5);
  const MatrixXcd M = Matrix(5, random);
  const MuUpper upper = LeastUpperBound(M);
  EXPECT_LE(upper.value, BalancedUpperBound(M).value);
  for (int k = 0; k < 2000; ++k) {
    Eigen::VectorXd x(5);
    for (double& value : x) value = normal(random);
    const MatrixXcd scaled =
        x.array().exp().matrix().asDiagonal() * M * (-x).array().exp().matrix().asDiagonal();
    EXPECT_GE(scaled.jacobiSvd().singularValues()(0), upper.value * (1 - 1.01e-4));
  }
}

// SLICOT's interior-point method AB13MD for the same bound.
TEST(StructuredSingularValue, TheBoundIsThatOfSlicot) {
  std::mt19937 random(5);
  for (int n = 2; n <= 5; ++n)
    for (int example = 0; example < 3; ++example) {
      MatrixXcd M = Matrix(n, random), z = M;
      const int work = 2 * n * n * n + 9 * n * n + 44 * n, zwork = 6 * n * n * n + 12 * (n * n + n);
      std::vector<int> block(static_cast<std::size_t>(n), 1), kind(block.size(), 2),
          integers(static_cast<std::size_t>(4 * n));
      std::vector<double> x(static_cast<std::size_t>(2 * n)), d(block.size()), g(block.size()),
          w(static_cast<std::size_t>(work));
      std::vector<Complex> zw(static_cast<std::size_t>(zwork));
      double bound = 0;
      int info = -1;
      ab13md_("N", &n, z.data(), &n, &n, block.data(), kind.data(), x.data(), &bound, d.data(),
              g.data(), integers.data(), w.data(), &work, zw.data(), &zwork, &info, 1);
      ASSERT_EQ(info, 0);
      EXPECT_NEAR(LeastUpperBound(M).value / bound, 1, 1e-4) << n;
    }
}

// Doyle's spinning body: two integrators coupled by the speed a. Each loop alone has an infinite
// gain margin
// and 90 degrees (α = 2); together  S - I/2 = [(s - 1)/2  -a; a  (s - 1)/2]/(s + 1), normal and
// with equal off-diagonals: no scaling helps, μ² = (1/4 + (ω/2 + a)²)/(1 + ω²) at the worse sign.
TEST(DiskMargin, OfTheSpinningBodyInClosedForm) {
  const double a = 10;
  std::vector<double> frequency;
  std::vector<MatrixXcd> S;
  double alone = 0, together = 0;
  for (int k = 0; k < 2000; ++k) {
    const double omega = 1e-3 * std::pow(10.0, 6.0 * k / 1999);
    const Complex s(0, omega);
    MatrixXcd m(2, 2);
    m << s, -a, a, s;
    S.push_back(m / (s + 1.0));
    frequency.push_back(omega / (2 * kPi));
    alone = std::max(alone, std::abs(S.back()(0, 0) - 0.5));
    together = std::max(
        together, std::sqrt((0.25 + (omega / 2 + a) * (omega / 2 + a)) / (1 + omega * omega)));
  }
  EXPECT_NEAR(1 / alone, 2, 1e-3);
  const auto joint = FindJointMargins(frequency, S);
  ASSERT_EQ(joint.size(), 1u);
  EXPECT_NEAR(joint[0].alpha * together, 1, 2e-4);
  // the bound chooses among neighbouring frequencies
  EXPECT_NEAR(joint[0].reached * together, 1, 1e-4);
  EXPECT_LT(joint[0].alpha, 0.11);  // a tenth where each alone bears two
  EXPECT_NEAR(DiskGainUp(joint[0].alpha), (2 + 1 / together) / (2 - 1 / together), 1e-4);
}

TEST(DiskMargin, GainsAndPhase) {
  EXPECT_NEAR(DiskGainUp(2.0 / 3), 2, 1e-12);
  EXPECT_NEAR(DiskGainDown(2.0 / 3), 0.5, 1e-12);
  EXPECT_NEAR(DiskPhase(2), kPi / 2, 1e-12);
  EXPECT_EQ(DiskGainDown(2.5), 0);
  EXPECT_EQ(DiskGainUp(2.5), kInfinity);
}

TEST(DiskMargin, AxesThatDoNotMoveOneAnotherStandAlone) {
  MatrixXcd S = MatrixXcd::Zero(3, 3);
  S(0, 0) = 2;
  S(2, 2) = 3;
  S(1, 1) = Complex(0, 4);
  S(0, 2) = 0.1;
  S(2, 0) = 0.1;
  const auto joint = FindJointMargins({1}, {S});
  ASSERT_EQ(joint.size(), 2u);
  EXPECT_EQ(joint[0].axes, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(joint[1].axes, std::vector<std::size_t>{1});
  EXPECT_NEAR(joint[1].alpha, 1 / std::abs(Complex(0, 4) - 0.5), 1e-12);
}

/// Spectral radius of the loop with every axis' command multiplied by a factor of its own.
double Radius(const ClosedLoop& loop, const Eigen::VectorXcd& factor) {
  const auto n = loop.axes();
  const Eigen::VectorXcd more = factor.array() - 1.0;
  const MatrixXcd Phi =
      loop.Phi.cast<Complex>() + loop.Gamma.middleCols(loop.Excitation(0), n).cast<Complex>() *
                                     more.asDiagonal() *
                                     loop.C.middleRows(loop.Command(0), n).cast<Complex>();
  return Eigen::ComplexEigenSolver<MatrixXcd>(Phi, false).eigenvalues().cwiseAbs().maxCoeff();
}

// The rig: within the margin every combination of gains is stable, and the change that was found
// puts a pole on the unit circle.
TEST(DiskMargin, IsWhereTheRigsPolesReachTheCircle) {
  const RigParameters rig = ReadRigText(ReferenceRigText(), "rig.toml");
  const OperatingPoint point = FindOperatingPoint(rig);
  const ClosedLoop loop(point, 500);
  const Sensitivity s = FindSensitivity(point, TransferFunction(point, loop), 500);
  ASSERT_EQ(s.joint.size(), 2u);  // four radial axes; the thrust bearing
  const JointMargin& m = s.joint[0];
  ASSERT_EQ(m.axes.size(), 4u);
  EXPECT_NEAR(s.joint[1].alpha, s.axes[4].disk_margin, 1e-6);
  double alone = kInfinity;
  for (std::size_t k : m.axes) alone = std::min(alone, s.axes[k].disk_margin);
  EXPECT_LT(m.alpha, alone);
  EXPECT_LE(m.alpha, m.reached * (1 + 1e-9));
  const double up = DiskGainUp(0.999 * m.alpha), down = DiskGainDown(0.999 * m.alpha);
  for (int signs = 0; signs < 16; ++signs) {
    Eigen::VectorXcd f = Eigen::VectorXcd::Ones(5);
    for (int k = 0; k < 4; ++k) f(k) = signs >> k & 1 ? up : down;
    EXPECT_LT(Radius(loop, f), 1) << signs;
  }
  const auto worst = [&](double part) {
    Eigen::VectorXcd f = Eigen::VectorXcd::Ones(5);
    for (std::size_t k = 0; k < 4; ++k) {
      const Complex delta = part * 2.0 * (m.factor[k] - 1.0) / (m.factor[k] + 1.0);
      EXPECT_NEAR(std::abs(delta), part * m.reached, 1e-9);
      f(static_cast<Eigen::Index>(m.axes[k])) = (1.0 + 0.5 * delta) / (1.0 - 0.5 * delta);
    }
    return Radius(loop, f);
  };
  EXPECT_LT(worst(0.98 * m.alpha / m.reached), 1);
  EXPECT_GT(worst(1.001), 1);
}

}  // namespace
}  // namespace ambrig
