// The least assignment against a look at every permutation.
#include "discovery/data/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace ambrig {
namespace {

double SumOf(const Eigen::MatrixXd& cost, const std::vector<std::size_t>& column) {
  double sum = 0;
  for (std::size_t k = 0; k < column.size(); ++k)
    sum += cost(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(column[k]));
  return sum;
}

TEST(Assignment, NoPermutationIsLess) {
  std::mt19937 draw(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int n = 1; n <= 6; ++n)
    for (int times = 0; times < 20; ++times) {
      const Eigen::MatrixXd cost =
          Eigen::MatrixXd::NullaryExpr(n, n, [&] { return uniform(draw); });
      std::vector<std::size_t> all(static_cast<std::size_t>(n));
      std::iota(all.begin(), all.end(), 0U);
      double least = SumOf(cost, all);
      do least = std::min(least, SumOf(cost, all));
      while (std::next_permutation(all.begin(), all.end()));
      std::vector<std::size_t> found = LeastAssignment(cost);
      EXPECT_NEAR(SumOf(cost, found), least, 1e-12) << n;
      std::sort(found.begin(), found.end());
      std::iota(all.begin(), all.end(), 0U);
      EXPECT_EQ(found, all);
    }
}

}  // namespace
}  // namespace ambrig
