// Eigenvalues of real matrices without vectors, against Eigen's Schur decomposition and against
// closed forms.
#include "core/math/real_eigenvalues.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

namespace ambrig {
namespace {

using Complex = std::complex<double>;

/// Largest distance of an eigenvalue to the nearest of the other list, each used once.
double Apart(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  std::vector<Complex> left(b.begin(), b.end());
  double worst = 0;
  for (const Complex x : a) {
    const auto best = std::min_element(left.begin(), left.end(), [&](Complex u, Complex v) {
      return std::abs(u - x) < std::abs(v - x);
    });
    worst = std::max(worst, std::abs(*best - x));
    left.erase(best);
  }
  return worst;
}

Eigen::VectorXcd EigenvaluesOf(const Eigen::MatrixXd& a) {
  Eigen::VectorXcd out;
  EXPECT_TRUE(RealEigenvalues(a, out));
  return out;
}

// A backward stable method is exact for a matrix a few n eps |A| away; for these, of condition 1e3
// at most, that moves an eigenvalue by less than 1e-10 |A|.
TEST(RealEigenvalues, AreThoseOfTheSchurDecomposition) {
  std::mt19937_64 draw(1);
  std::normal_distribution<double> normal;
  for (const int n : {1, 2, 3, 4, 7, 20, 60}) {
    const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(draw); });
    const Eigen::EigenSolver<Eigen::MatrixXd> schur(a, false);
    EXPECT_LT(Apart(EigenvaluesOf(a), schur.eigenvalues()), 1e-10 * a.norm()) << n;
  }
}

// [[0, 1], [-w², -2 zeta w]] on the diagonal: s = -zeta w ± i w √(1 - zeta²), over six decades,
// mixed by an orthogonal matrix.
TEST(RealEigenvalues, OfDampedOscillators) {
  const int n = 8;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  Eigen::VectorXcd exact(2 * n);
  for (int k = 0; k < n; ++k) {
    const double w = std::pow(10.0, k * 0.4), zeta = 0.05 + 0.1 * k;
    a.block<2, 2>(2 * k, 2 * k) << 0, w, -w, -2 * zeta * w;
    exact(2 * k) = Complex(-zeta * w, w * std::sqrt(1 - zeta * zeta));
    exact(2 * k + 1) = std::conj(exact(2 * k));
  }
  std::mt19937_64 draw(2);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd q = Eigen::MatrixXd::NullaryExpr(2 * n, 2 * n, [&] { return normal(draw); })
                                .householderQr()
                                .householderQ();
  EXPECT_LT(Apart(EigenvaluesOf(q.transpose() * a * q), exact), 1e-12 * a.norm());
}

// The cyclic shift does not change under an unshifted QR step: without exceptional shifts it would
// go on for ever.
TEST(RealEigenvalues, RootsOfUnityAndDefectiveMatrices) {
  const int n = 6;
  Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXcd roots(n);
  for (int k = 0; k < n; ++k) {
    shift((k + 1) % n, k) = 1;
    roots(k) = std::polar(1.0, 2 * std::acos(-1.0) * k / n);
  }
  EXPECT_LT(Apart(EigenvaluesOf(shift), roots), 1e-13);
  Eigen::MatrixXd jordan = 3 * Eigen::MatrixXd::Identity(2, 2);
  jordan(0, 1) = 1;
  EXPECT_LT(Apart(EigenvaluesOf(jordan), Eigen::VectorXcd::Constant(2, 3)), 1e-7);  // root of eps
  EXPECT_LT(EigenvaluesOf(Eigen::MatrixXd::Zero(5, 5)).norm(), 1e-300);
}

TEST(RealEigenvalues, SaysWhereTheyDoNotExist) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(4, 4);
  a(2, 1) = std::nan("");
  Eigen::VectorXcd out;
  EXPECT_FALSE(RealEigenvalues(a, out));
}

}  // namespace
}  // namespace ambrig
