// What a linear step promises, on a problem that is linear.
#include "discovery/search/linear_step.h"

#include <gtest/gtest.h>

#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

FitOptions AtThePoint() {
  FitOptions o;
  o.effective_sample_size = 300;
  o.iterations = 0;
  return o;
}

// The data are 1.07 x + 3 um; at gain 1.01 and offset 1 um the step promises what a fit finds.
TEST(LinearStep, PromisesWhatAFitOfALinearProblemReaches) {
  const LinearCase c{{2e-5, 4e-5, 6e-5, 5e-5}, 1.07, 3e-6};
  const Hypothesis start = c.With({LinearCase::Gain(1.01), LinearCase::Offset(1e-6)});
  const FitResult now = Fit(c.model, start, AtThePoint());
  const FitResult promised = LinearlyRefitted(c.model, now, 300);
  EXPECT_GT(now.ratio_fit, 2);
  EXPECT_LT(promised.ratio_fit, 0.01);
  EXPECT_LT(promised.ratio_validate, 0.01);  // the record kept back has the same law
  EXPECT_EQ(promised.hypothesis.free[0].value, now.hypothesis.free[0].value);
  EXPECT_EQ(promised.predicted, now.predicted);
}

// A gain alone cannot make the offset: what stays is the residual of the best line through zero,
// 3 um (1 - x Σx/Σx²) for the fitted records.
TEST(LinearStep, LeavesWhatItsParametersCannotMake) {
  const LinearCase c{{2e-5, 4e-5, 6e-5, 5e-5}, 1.0, 3e-6};
  const FitResult now = Fit(c.model, c.With({LinearCase::Gain(1.01)}), AtThePoint());
  const FitResult promised = LinearlyRefitted(c.model, now, 300);
  double sum = 0, square = 0, left = 0;
  for (std::size_t r = 0; r < c.fit_records(); ++r) sum += c.x[r], square += c.x[r] * c.x[r];
  for (std::size_t r = 0; r < c.fit_records(); ++r) {
    const double e = 3e-6 * (1 - c.x[r] * sum / square) / LinearCase::kFloor;
    left += e * e;
  }
  // beside every A.x stands an A.y without error
  EXPECT_NEAR(promised.ratio_fit, std::sqrt(left / (2.0 * c.fit_records())), 1e-3);
}

// Without sensitivities there is no step.
TEST(LinearStep, WithoutParametersNothingChanges) {
  const LinearCase c{{2e-5, 4e-5, 5e-5}, 1.05, 0};
  const FitResult now = c.Base();
  const FitResult promised = LinearlyRefitted(c.model, now, 300);
  EXPECT_DOUBLE_EQ(promised.ratio_fit, now.ratio_fit);
  EXPECT_EQ(promised.residual, now.residual);
}

}  // namespace
}  // namespace ambrig
