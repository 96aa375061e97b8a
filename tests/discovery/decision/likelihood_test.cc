// The weight of an error and its price: derivative, floor and limits in closed form.
#include "discovery/decision/likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ambrig {
namespace {

TEST(Likelihood, WeightIsTheSlopeOfTheMisfit) {
  for (const double n : {50.0, 2e4, 2e5})
    for (const double ratio : {1.001, 1.1, 2.0, 15.0}) {
      const double h = 1e-6 * ratio * ratio;
      const double up = Misfit(std::sqrt(ratio * ratio + h), n),
                   down = Misfit(std::sqrt(ratio * ratio - h), n);
      EXPECT_NEAR((up - down) / (2 * h), MisfitWeight(ratio, n), 1e-4 * MisfitWeight(ratio, n))
          << ratio << " " << n;
    }
}

TEST(Likelihood, AtTheFloorEveryNumberCounts) {
  EXPECT_EQ(Misfit(1, 1e5), 0);
  EXPECT_EQ(MisfitWeight(1, 1e5), 1e5);
  EXPECT_NEAR(Misfit(std::sqrt(1 + 1e-6), 1e5), 0.1, 1e-4);  // n (R² - 1)
  EXPECT_NEAR(Misfit(std::sqrt(1 - 1e-3), 1e5), -100, 1e-9);
}

// Far above the floor the price of halving the excess no longer depends on how many rows there are.
TEST(Likelihood, FarAboveTheFloorOnlyThreeHundredNumbersCount) {
  const auto halving = [](double n) {
    return Misfit(std::sqrt(1 + 100.0), n) - Misfit(std::sqrt(1 + 50.0), n);
  };
  EXPECT_NEAR(halving(1e6), 300 * std::log(2.0), 0.1);
  EXPECT_NEAR(halving(1e4), halving(1e6), 1);
}

}  // namespace
}  // namespace ambrig
