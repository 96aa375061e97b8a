// The distribution of a normal deviate: tables, and its inverse.
#include "core/math/normal_distribution.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ambrig {
namespace {

TEST(NormalDistribution, HasTheTablesProbabilities) {
  EXPECT_NEAR(NormalProbability(0), 0.5, 1e-15);
  EXPECT_NEAR(NormalProbability(1), 0.841344746068543, 1e-14);
  EXPECT_NEAR(NormalProbability(-2), 0.0227501319481792, 1e-15);
}

TEST(NormalDistribution, TheQuantileInvertsIt) {
  for (const double p : {1e-12, 1e-6, 0.001, 0.2, 0.5, 0.7, 0.999, 1 - 1e-9})
    EXPECT_NEAR(NormalProbability(NormalQuantile(p)), p, 1e-12 * std::max(1.0, p)) << p;
  EXPECT_NEAR(NormalQuantile(0.975), 1.959963984540054, 1e-12);
}

}  // namespace
}  // namespace ambrig
