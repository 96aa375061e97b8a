#include "core/math/line_weights.h"

#include <gtest/gtest.h>

namespace ambrig {
namespace {

// Weights reproduce every straight line and, with more places than two, smooth by least squares.
TEST(LineWeights, ReproduceStraightLines) {
  const std::vector<double> planes = {-0.2, 0.05, 0.3};
  for (const double z : {-0.2, 0.0, 0.4}) {
    const std::vector<double> w = LineWeights(planes, z);
    double one = 0, line = 0;
    for (std::size_t k = 0; k < planes.size(); ++k) {
      one += w[k];
      line += w[k] * planes[k];
    }
    EXPECT_NEAR(one, 1, 1e-12);
    EXPECT_NEAR(line, z, 1e-12);
  }
  const std::vector<double> same = LineWeights({0.1, 0.1}, 0.7);  // no line through one plane
  EXPECT_DOUBLE_EQ(same[0], 0.5);
  EXPECT_DOUBLE_EQ(same[1], 0.5);
  EXPECT_DOUBLE_EQ(LineWeights({0.3}, 0)[0], 1);
}

}  // namespace
}  // namespace ambrig
