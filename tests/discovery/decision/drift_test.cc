// Corrections of one parameter, record by record: constant ones hold, others are told by
// chi-squared.
#include "discovery/decision/drift_test.h"

#include <gtest/gtest.h>

#include <cmath>

#include "discovery/search/likelihood.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

TEST(TestDrift, ConstantCorrectionsHold) {
  const DriftTest t = TestDrift({0.3, 0.3, 0.3}, {1, 20, 400});
  EXPECT_NEAR(t.q, 0, 1e-24);
  EXPECT_EQ(t.freedom, 2);
  EXPECT_TRUE(t.holds);
}

// Of two: q = w1 w2/(w1 + w2) (v1 - v2)².
TEST(TestDrift, OfTwoRecordsIsTheirDifference) {
  EXPECT_NEAR(TestDrift({0, 3}, {1, 1}).q, 4.5, 1e-12);
  EXPECT_NEAR(TestDrift({1, 3}, {2, 6}).q, 2.0 * 6 / 8 * 4, 1e-12);
}

// What laws differ by adds to the variance of each: w = 1/(1/w1 + 0.5²).
TEST(TestDrift, RecordsThatTellMoreFinelyThanLawsAgreeMayDiffer) {
  EXPECT_NEAR(TestDrift({0, 3}, {1, 1}, 0.5).q, 4.5 / 1.25, 1e-12);
  EXPECT_FALSE(TestDrift({1, 1.1}, {1e6, 1e6}).holds);
  EXPECT_TRUE(TestDrift({1, 1.1}, {1e6, 1e6}, 0.05).holds);
}

// 99 of 100: 6.63 for one degree of freedom, 13.28 for four, 23.21 for ten (tables of chi-squared);
// the approximation errs by less than 1 %.
TEST(TestDrift, TheLimitIsThatOfChiSquared) {
  const auto holds = [](int freedom, double q) {
    // all at zero but one pair at +-d: q = 2 d²
    std::vector<double> value(static_cast<std::size_t>(freedom) + 1, 0);
    value[0] = std::sqrt(q / 2);
    value[1] = -value[0];
    const DriftTest t = TestDrift(value, std::vector<double>(value.size(), 1.0));
    EXPECT_EQ(t.freedom, freedom);
    EXPECT_NEAR(t.q, q, 1e-12 * q);
    return t.holds;
  };
  const double limit[][2] = {{1, 6.635}, {4, 13.277}, {10, 23.209}};
  for (const auto& [freedom, q] : limit) {
    EXPECT_TRUE(holds(static_cast<int>(freedom), 0.99 * q)) << freedom;
    EXPECT_FALSE(holds(static_cast<int>(freedom), 1.01 * q)) << freedom;
  }
}

TEST(TestDrift, RecordsThatDoNotSeeTheParameterDoNotCount) {
  const DriftTest t = TestDrift({0, 100, 0.5, -7}, {1, 1e-9, 1, 0});
  EXPECT_EQ(t.freedom, 1);
  EXPECT_NEAR(t.q, 0.125, 1e-12);
  const DriftTest alone = TestDrift({5, 100}, {1, 0});
  EXPECT_EQ(alone.freedom, 0);
  EXPECT_EQ(alone.q, 0);
  EXPECT_TRUE(alone.holds);  // one record cannot contradict itself
}

// A gain fitted to readings that have an offset: each record asks for a gain of its own, o/x.
TEST(TestDrift, AParameterThatStandsInForAnotherDrifts) {
  for (const double offset : {0.0, 4e-6}) {
    const LinearCase c({2e-5, 4e-5, 6e-5, 5e-5}, 1.05, offset);
    FitOptions options;
    options.effective_sample_size = 300;
    const FitResult fit = Fit(c.model, c.With({LinearCase::Gain(1.01)}), options);
    ASSERT_TRUE(fit.converged);
    const double weight = MisfitWeight(1, 300) / static_cast<double>(c.model.size());
    const DriftTest t = TestDrift(c.model, fit, 0, weight);
    EXPECT_EQ(t.freedom, 3);
    EXPECT_EQ(t.holds, offset == 0);
    // Σ w (o/x - mean)², w = weight 50 x²/floor²
    double n = 0, mean = 0, q = 0;
    for (const double x : c.x) n += x * x, mean += x * offset;
    for (const double x : c.x) q += x * x * std::pow(offset / x - mean / n, 2);
    q *= weight * LinearCase::kRows / (LinearCase::kFloor * LinearCase::kFloor);
    EXPECT_NEAR(t.q, q, 0.02 * q + 1e-3);
  }
}

}  // namespace
}  // namespace ambrig
