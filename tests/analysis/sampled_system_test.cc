// Responses by the triangular form against the equations solved directly.
#include "analysis/sampled_system.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

namespace ambrig {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

MatrixXd Random(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

TEST(SampledSystem, SolvesTheEquationsOfTheSystem) {
  for (const Eigen::Index n : {1, 2, 3, 12, 35}) {
    const MatrixXd A = Random(n, n, 1) / std::sqrt(static_cast<double>(n)), B = Random(n, 3, 2),
                   C = Random(2, n, 3);
    const SampledSystem system(A, B, C);
    for (const double angle : {0.1, 1.3, 3.0}) {
      const std::complex<double> z = std::polar(1.0, angle);
      const MatrixXcd state = (z * MatrixXcd::Identity(n, n) - A.cast<std::complex<double>>())
                                  .partialPivLu()
                                  .solve(B.cast<std::complex<double>>());
      const MatrixXcd direct = C.cast<std::complex<double>>() * state;
      EXPECT_LT((system.At(z) - direct).norm(), 1e-10 * direct.norm());
      EXPECT_LT((system.At(z, {2, 0}).col(0) - direct.col(2)).norm(), 1e-10 * direct.norm());
      const Eigen::VectorXcd added = B.col(1).cast<std::complex<double>>();
      EXPECT_LT((system.Under(z, added) - direct.col(1)).norm(), 1e-10 * direct.norm());
    }
  }
}

TEST(SampledSystem, EigenvaluesAreThoseOfA) {
  const MatrixXd A = Random(20, 20, 7);
  const SampledSystem system(A, Random(20, 1, 8), Random(1, 20, 9));
  const Eigen::VectorXcd values = Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues();
  for (const std::complex<double>& value : values)
    EXPECT_LT((system.eigenvalues().array() - value).abs().minCoeff(), 1e-10);
}

}  // namespace
}  // namespace ambrig
