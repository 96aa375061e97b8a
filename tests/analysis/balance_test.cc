// Balancing: like norms of rows and columns, exact powers of two, the same system.
#include "analysis/balance.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/math/noise.h"

namespace ambrig {
namespace {

/// A random system whose states have units that differ by twelve decades.
Eigen::MatrixXd Badly(int n) {
  Eigen::MatrixXd A(n, n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      A(r, c) = Normal(9, 0, static_cast<std::uint64_t>(r * n + c)) *
                std::pow(10.0, 12.0 * (r - c) / (n - 1));
  return A;
}

Eigen::MatrixXd Scaled(const Eigen::MatrixXd& A, const Eigen::VectorXd& d) {
  return d.cwiseInverse().asDiagonal() * A * d.asDiagonal();
}

TEST(Balance, RowsAndColumnsGetLikeNorms) {
  const Eigen::MatrixXd A = Badly(6);
  const Eigen::MatrixXd B = Scaled(A, BalancingSizes(A));
  for (int k = 0; k < 6; ++k) {
    const double off_row = B.row(k).lpNorm<1>() - std::abs(B(k, k)),
                 off_column = B.col(k).lpNorm<1>() - std::abs(B(k, k));
    EXPECT_LT(std::abs(std::log2(off_row / off_column)), 1.5) << k;
  }
  EXPECT_LT(B.norm(), 1e-6 * A.norm());
}

// Powers of two: no digit is lost, and eigenvalues are those of the same matrix.
TEST(Balance, SizesArePowersOfTwo) {
  const Eigen::MatrixXd A = Badly(5);
  const Eigen::VectorXd d = BalancingSizes(A);
  for (const double size : d) {
    int exponent = 0;
    EXPECT_EQ(std::frexp(size, &exponent), 0.5);
  }
  const Eigen::MatrixXd B = Scaled(A, d);
  EXPECT_NEAR(B.trace(), A.trace(), 1e-12 * std::abs(A.trace()));
  EXPECT_EQ(Scaled(B, d.cwiseInverse()), A);  // bit by bit
}

TEST(Balance, ABalancedSystemIsLeftAlone) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(2, 2) << 0, 1, -1, 0).finished();
  EXPECT_EQ(BalancingSizes(A), Eigen::VectorXd::Ones(2));
  EXPECT_EQ(BalancingSizes(Eigen::MatrixXd::Zero(3, 3)), Eigen::VectorXd::Ones(3));
}

}  // namespace
}  // namespace ambrig
