// What of a fit's residuals counts: what one coil has of its own.
#include "fdd/learning/fit_grade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

/// Rows of a healthy bearing of eight coils, and the coils' nominal equations.
struct GradedRows {
  Bench bench;
  CommissioningLog log{kSamples};
  CoilDetectorSetup setup;
  CoilEquations coils;
  std::unique_ptr<CommissioningRows> rows;

  GradedRows() : setup(SetupOf(bench)) {
    for (int n = 0; n < 800; ++n) {
      for (int j = 0; j < kLanes; ++j) bench.duty[j] = 0.535 + 0.005 * std::sin(0.05 * n + j);
      const MeasuredPeriod in = bench.Run();
      if (n >= 400) log.Add(in);  // from then on all coils carry current
    }
    for (int j = 0; j < kLanes; ++j) {
      coils.gain[j] = 1;
      coils.leakage[j] = setup.model.leakage[j];
      coils.resistance[j] = setup.model.resistance[j];
    }
    rows = std::make_unique<CommissioningRows>(setup.model, setup.settings.sampling,
                                               ExcessSettings{}, log);
  }
  /// Grade of rows whose relative errors are `c` of their coil.
  double Grade(const std::function<double(int)>& c) const {
    std::vector<double> z;
    for (const CommissioningRow& r : rows->rows())
      z.push_back(c(r.coil) * (r.voltage - coils.resistance[r.coil] * r.mean) * r.weight);
    return FitGrade(setup.model, *rows, coils, z);
  }
};

TEST(FitGrade, WhatADisplacedShaftMakesDoesNotCount) {
  const GradedRows rows;
  const LinkageModel& m = rows.setup.model;
  ASSERT_GT(rows.rows->rows().size(), 700U);
  const auto displaced = [&](int j) {
    return 0.02 + 0.05 * m.direction_x[j] - 0.03 * m.direction_y[j];
  };
  EXPECT_LT(rows.Grade(displaced), 1e-9);
}

// Of one coil's c a fit of three patterns to eight leaves five eighths, which is what five degrees of freedom carry; the
// voltages of the coils differ by a few per cent.
TEST(FitGrade, WhatOneCoilHasOfItsOwnCounts) {
  const GradedRows rows;
  const auto of = [&](int coil, double c) {
    return rows.Grade([&](int j) { return j == coil ? c : 0; });
  };
  const double small = of(3, 1e-3);
  EXPECT_GT(small, 0);
  EXPECT_NEAR(of(3, 2e-3), 4 * small, 1e-6 * small);
  double square = 0, count = 0;
  for (const CommissioningRow& r : rows.rows->rows()) {
    const double z = (r.voltage - rows.coils.resistance[r.coil] * r.mean) * r.weight;
    if (r.coil == 3) square += 1e-6 * z * z;
    count += 1;
  }
  EXPECT_NEAR(small, square / count, 0.05 * small);
  EXPECT_GT(of(3, 0.3), 3);  // a loss of an eighth of its turns
}

// Far out a residual counts linearly: few that nothing explains do not rule.
TEST(FitGrade, LargeResidualsCountLinearly) {
  EXPECT_EQ(HuberCost(1.5), 2.25);
  EXPECT_EQ(HuberCost(-10), 36);
  EXPECT_EQ(HuberCost(20) - HuberCost(10), HuberCost(30) - HuberCost(20));
}

}  // namespace
}  // namespace ambrig
