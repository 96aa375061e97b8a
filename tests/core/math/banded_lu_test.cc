// Banded elimination against dense elimination of the same matrix.
#include "core/math/banded_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <complex>
#include <random>

namespace ambrig {
namespace {

using Complex = std::complex<double>;

/// Entries of size 1 within the band; small ones on the diagonal, so that rows are exchanged.
Eigen::MatrixXcd Banded(int n, int below, int above) {
  std::mt19937_64 draw(7);
  std::normal_distribution<double> normal;
  Eigen::MatrixXcd a = Eigen::MatrixXcd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - below); j <= std::min(n - 1, i + above); ++j)
      a(i, j) = Complex(normal(draw), normal(draw)) * (i == j ? 1e-3 : 1.0);
  return a;
}

TEST(BandedLu, SolvesAsDenseEliminationDoes) {
  for (const auto& [n, below, above] : {std::array{1, 0, 0}, {5, 1, 2}, {40, 7, 7}, {30, 3, 12}}) {
    const Eigen::MatrixXcd a = Banded(n, below, above);
    BandedLu lu(n, below, above);
    for (int twice = 0; twice < 2; ++twice) {  // the same object serves one matrix after the other
      lu.Clear();
      for (int i = 0; i < n; ++i)
        for (int j = std::max(0, i - below); j <= std::min(n - 1, i + above); ++j)
          lu.Set(i, j, a(i, j));
      ASSERT_TRUE(lu.Factorise());
    }
    const Eigen::VectorXcd right = Eigen::VectorXcd::LinSpaced(n, Complex(1, 0), Complex(2, 3));
    Eigen::VectorXcd x = right;
    lu.Solve(x);
    EXPECT_LT((a * x - right).norm(), 1e-12 * a.norm() * x.norm()) << n;
    EXPECT_LT((x - a.partialPivLu().solve(right)).norm(), 1e-9 * x.norm()) << n;
  }
}

TEST(BandedLu, SaysWhatIsSingular) {
  BandedLu lu(3, 1, 1);
  lu.Set(0, 0, 1);
  lu.Set(2, 2, 1);  // nothing in column 1
  EXPECT_FALSE(lu.Factorise());
}

}  // namespace
}  // namespace ambrig
