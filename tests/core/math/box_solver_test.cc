#include "core/math/box_solver.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/math/noise.h"

namespace ambrig {
namespace {

using Eigen::Index;

// The conditions of an optimum (Karush, Kuhn, Tucker): no slope inside, none that points inwards at
// a limit. They are sufficient, because the problem is convex.
TEST(BoxSolver, MeetsTheConditionsOfAnOptimum) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Index n = 3 + static_cast<Index>(seed % 17);
    Eigen::MatrixXd M(n + 2, n);
    Eigen::VectorXd b(n), lo(n), hi(n);
    std::uint64_t drawn = 0;
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < n + 2; ++i) M(i, j) = Normal(seed, 1, drawn++);
      b(j) = 5 * Normal(seed, 2, static_cast<std::uint64_t>(j));
      lo(j) = j % 3 == 0 ? -1e300 : -0.2 * static_cast<double>(j % 4);
      hi(j) = j % 5 == 0 ? 1e300 : 0.5;
    }
    const Eigen::MatrixXd A = M.transpose() * M + 1e-3 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd x = SolveInBox(A, b, lo, hi), slope = A * x - b;
    for (Index k = 0; k < n; ++k) {
      ASSERT_GE(x(k), lo(k));
      ASSERT_LE(x(k), hi(k));
      const double small = 1e-8 * b.cwiseAbs().maxCoeff();
      if (x(k) > lo(k)) {
        EXPECT_LE(slope(k), small) << seed << " " << k;
      }
      if (x(k) < hi(k)) {
        EXPECT_GE(slope(k), -small) << seed << " " << k;
      }
    }
  }
}

TEST(BoxSolver, NonNegativeLeastSquaresLeavesOutWhatWouldBeNegative) {
  // x1 alone: (1, 0.5)·b over |(1, 0.5)|²; x2 wants to be negative.
  Eigen::MatrixXd M(2, 2);
  M << 1, 1, 0.5, 1;
  const Eigen::Vector2d y(1, 0.2), none(0, 0), much(1e9, 1e9);
  const Eigen::VectorXd x = SolveInBox(M.transpose() * M, M.transpose() * y, none, much);
  EXPECT_NEAR(x(0), 1.1 / 1.25, 1e-12);
  EXPECT_EQ(x(1), 0);
}

}  // namespace
}  // namespace ambrig
