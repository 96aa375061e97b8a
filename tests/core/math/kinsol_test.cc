#include "core/math/kinsol.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ambrig {
namespace {

// u1² + u2² = 4, u1 = u2: both are √2.
TEST(Kinsol, SolvesAndReportsResidual) {
  const auto F = [](const double* u, double* f) {
    f[0] = u[0] * u[0] + u[1] * u[1] - 4;
    f[1] = u[0] - u[1];
  };
  const KinsolOutcome out = SolveKinsol(F, {1, 3}, {1, 1}, {1, 1}, 1e-12);
  ASSERT_TRUE(out.converged) << out.message;
  EXPECT_NEAR(out.u[0], std::sqrt(2), 1e-11);
  EXPECT_NEAR(out.u[1], std::sqrt(2), 1e-11);
  EXPECT_LE(out.residual, 1e-12);
}

TEST(Kinsol, SaysWhenThereIsNoSolution) {
  const auto F = [](const double* u, double* f) { f[0] = u[0] * u[0] + 1; };
  const KinsolOutcome out = SolveKinsol(F, {3}, {1}, {1});
  EXPECT_FALSE(out.converged);
  EXPECT_FALSE(out.message.empty());
}

}  // namespace
}  // namespace ambrig
