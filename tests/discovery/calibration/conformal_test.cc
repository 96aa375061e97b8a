// Conformal sets: p-values by hand, and the promise itself on scores that were not used.
#include "discovery/calibration/conformal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/noise.h"

namespace ambrig {
namespace {

std::vector<double> Ladder(int n) {
  std::vector<double> scores;
  for (int k = 1; k <= n; ++k) scores.push_back(0.01 * k);
  return scores;
}

TEST(Conformal, PValuesByHand) {
  const std::vector<double> scores = Ladder(19);
  EXPECT_DOUBLE_EQ(ConformalPValue(scores, 0.19), 2.0 / 20);
  EXPECT_DOUBLE_EQ(ConformalPValue(scores, 0.2), 1.0 / 20);
  EXPECT_DOUBLE_EQ(ConformalPValue(scores, 0), 1);
}

// 19 scores: the largest has 2/20 > 0.05. 39: 2/40 is not above 0.05, the second, 0.38, has 3/40.
TEST(Conformal, ThresholdByHand) {
  EXPECT_NEAR(LeastProbabilityOfSet(Ladder(19), 0.95), 1 - 0.19, 1e-12);
  EXPECT_NEAR(LeastProbabilityOfSet(Ladder(39), 0.95), 1 - 0.38, 1e-12);
}

TEST(Conformal, TooFewCasesLeaveEveryNameIn) {
  EXPECT_EQ(LeastProbabilityOfSet(Ladder(10), 0.95), 0);
  EXPECT_EQ(LeastProbabilityOfSet({}, 0.95), 0);
}

// More than one in twenty without any probability for the right answer: no threshold holds 95 %.
TEST(Conformal, MissesOpenTheSet) {
  std::vector<double> scores = Ladder(90);
  scores.insert(scores.end(), 10, 1.0);
  EXPECT_EQ(LeastProbabilityOfSet(scores, 0.95), 0);
}

// Scores of any law: 200 sets of 99 scores, one new score each. It is in with a probability of 95 %
// to 96 %; of 200 the share has an sd of 1.5 %.
TEST(Conformal, HoldsWhatItPromises) {
  int in = 0;
  for (std::uint32_t set = 0; set < 200; ++set) {
    std::vector<double> scores;
    for (std::uint32_t k = 0; k < 99; ++k) scores.push_back(std::pow(Uniform(5, set, k), 3));
    const double fresh = std::pow(Uniform(5, set, 99), 3);
    in += 1 - fresh >= LeastProbabilityOfSet(scores, 0.95) ? 1 : 0;
  }
  EXPECT_NEAR(in / 200.0, 0.955, 3 * 0.015);
}

}  // namespace
}  // namespace ambrig
