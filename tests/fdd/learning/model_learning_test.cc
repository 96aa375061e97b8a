// What residuals teach of the model's error: Bayes' rule with forgetting, in closed form.
#include "fdd/learning/model_learning.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/noise.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

constexpr double kLeakageSd = 2e-5, kGapSd = 0.02;  // [H], [-]

/// One period with current slopes and flux slopes of its own in every coil, residuals of a model
/// whose leakage and gap err by `leakage` and `gap`, and noise of `noise` [V].
PeriodSlopes Slopes(const LinkageModel& m, std::uint64_t period, double leakage, double gap,
                    double noise) {
  PeriodSlopes s;
  for (int q = 0; q < 2; ++q)
    for (int j = 0; j < kLanes; ++j) {
      const auto slot = static_cast<std::uint32_t>(8 * q + j);
      const double di = 4e3 * Normal(5, slot, period), flux = 20 * Normal(6, slot, period);
      PhaseSlopes& p = s.phase[q];
      p.current[j] = di;
      p.linkage[j] = flux + m.leakage[j] * di;
      p.residual[j] = -leakage * di + gap * flux + noise * Normal(7, slot, period);
    }
  return s;
}

/// All residuals hold, with this expected size [V].
ResidualChart Chart(double sd) {
  ResidualChart c;
  for (int q = 0; q < 2; ++q)
    for (int j = 0; j < kLanes; ++j) {
      c.valid[q][j] = 1;
      c.per_sd[q][j] = 1 / sd;
      c.z[q][j] = 1;
    }
  return c;
}

TEST(ModelLearning, KnowsTheTolerancesAtFirst) {
  const ModelLearning learning(kLeakageSd, kGapSd);
  EXPECT_EQ(learning.known().leakage, 0);
  EXPECT_EQ(learning.known().gap, 0);
  // Three times the tolerance, squared, and what coils differ by: 0.2² and 0.3² of it.
  EXPECT_NEAR(learning.known().uncertainty[0], 9.04 * kLeakageSd * kLeakageSd, 1e-18);
  EXPECT_NEAR(learning.known().uncertainty[1], 0, 1e-30);
  EXPECT_NEAR(learning.known().uncertainty[2], 9.09 * kGapSd * kGapSd, 1e-12);
}

// 16 equations a period, 500 periods of memory: the prior hardly counts any more.
TEST(ModelLearning, FindsLeakageAndGapErrorApart) {
  const LinkageModel m = MakeLinkageModel(testing_bench::Reference());
  ModelLearning learning(kLeakageSd, kGapSd);
  ResidualChart chart = Chart(0.2);
  for (std::uint64_t k = 0; k < 3000; ++k)
    learning.Learn(m, Slopes(m, k, 1.5e-5, -0.013, 0.2), 1, &chart);
  // sd of the estimates: 0.2/(4e3 √8000), 0.2/(20 √8000)
  EXPECT_NEAR(learning.known().leakage, 1.5e-5, 4 * 0.2 / 4e3 / std::sqrt(8000));
  EXPECT_NEAR(learning.known().gap, -0.013, 4 * 0.2 / 20 / std::sqrt(8000));
  // What is left of the uncertainty: three sd of the estimate, and how coils differ.
  const double leakage = 9 * 0.04 / (8000 * 4e3 * 4e3) + 0.04 * kLeakageSd * kLeakageSd,
               gap = 9 * 0.04 / (8000 * 20 * 20) + 0.09 * kGapSd * kGapSd;
  EXPECT_NEAR(learning.known().uncertainty[0], leakage, 0.1 * leakage);
  EXPECT_NEAR(learning.known().uncertainty[2], gap, 0.1 * gap);
}

// One period that stands for ten is ten times the information.
TEST(ModelLearning, APeriodMayStandForSeveral) {
  const LinkageModel m = MakeLinkageModel(testing_bench::Reference());
  const PeriodSlopes s = Slopes(m, 3, 1e-5, 0, 0);
  ModelLearning once(kLeakageSd, kGapSd), tenfold(kLeakageSd, kGapSd);
  ResidualChart a = Chart(5), b = Chart(5 / std::sqrt(10.0));
  once.Learn(m, s, 10, &a);
  tenfold.Learn(m, s, 1, &b);
  EXPECT_NEAR(once.known().leakage, tenfold.known().leakage, 1e-3 * once.known().leakage);
  EXPECT_GT(once.known().leakage, 0);
  EXPECT_LT(once.known().leakage, 1e-5);  // the prior still draws it to zero
}

TEST(ModelLearning, BelievesNoMoreThanFiveTolerances) {
  const LinkageModel m = MakeLinkageModel(testing_bench::Reference());
  ModelLearning learning(kLeakageSd, kGapSd);
  ResidualChart chart = Chart(0.2);
  for (std::uint64_t k = 0; k < 2000; ++k)
    learning.Learn(m, Slopes(m, k, -9 * kLeakageSd, 9 * kGapSd, 0), 1, &chart);
  EXPECT_DOUBLE_EQ(learning.known().leakage, -5 * kLeakageSd);
  EXPECT_DOUBLE_EQ(learning.known().gap, 5 * kGapSd);
}

// |z| of every coil approaches its usual size with a memory of 200 periods; one of 50 says no more
// than 4.
TEST(ModelLearning, FollowsTheUsualSizeOfEveryResidual) {
  const LinkageModel m = MakeLinkageModel(testing_bench::Reference());
  ModelLearning learning(kLeakageSd, kGapSd);
  ResidualChart chart = Chart(0.2);
  chart.z[0][1] = -2;
  chart.z[0][2] = 50;
  chart.valid[0][3] = 0;
  chart.size[0][3] = 0.7;
  for (std::uint64_t k = 0; k < 400; ++k) learning.Learn(m, Slopes(m, k, 0, 0, 0.2), 1, &chart);
  const double reached = 1 - std::pow(1 - 1.0 / 200, 400);
  EXPECT_NEAR(chart.size[0][0], reached, 1e-9);
  EXPECT_NEAR(chart.size[0][1], 2 * reached, 1e-9);
  EXPECT_NEAR(chart.size[0][2], 4 * reached, 1e-9);
  EXPECT_EQ(chart.size[0][3], 0.7);  // its equation did not hold
}

}  // namespace
}  // namespace ambrig
