// Effects that act in whole switching periods have no slope that a fit could follow.
#include "discovery/search/whole_periods.h"

#include <gtest/gtest.h>

#include "discovery/search/fit.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

EffectInstance DelayOfPeriods(double periods) {
  EffectInstance e = MakeInstance(EffectNamed("loop-delay"), "rig");
  e.Set("time", periods / testing::RadialRig().amplifier.switching_frequency);
  return e;
}

TEST(WholePeriods, AreThoseOfADelayOnly) {
  const Case c = testing::Measured();
  const CaseModel model(c, 12);
  Hypothesis h = Hypothesis::Base(c.rig);
  h.AddEffect(DelayOfPeriods(1.5));
  const double period = 1 / c.rig.amplifier.switching_frequency;
  for (const FreeParameter& f : h.free)
    EXPECT_EQ(WholePeriodOf(model, h, f), f.effect < 0 ? 0 : period) << f.path;
}

// The reading of a delay that is two periods too short or too long: the fit walks to the period of
// the data, and says what is known of the delay.
TEST(WholePeriods, AFitWalksFromPeriodToPeriod) {
  const Case c = testing::Measured({DelayOfPeriods(3)}, 0, "multisine at rest");
  const CaseModel model(c, 12);
  for (const double start : {0.5, 4.5}) {
    Hypothesis h;
    h.rig = c.rig;
    h.AddEffect(DelayOfPeriods(start));
    FitOptions options;
    options.passes = 5;
    options.effective_sample_size = 300;
    const FitResult fit = Fit(model, h, options);
    ASSERT_TRUE(fit.converged);
    const EffectInstance found = FittedEffect(fit, 0);
    const double period = 1 / c.rig.amplifier.switching_frequency;
    EXPECT_NEAR(found.Value("time"), 2.5 * period, 1e-9) << start;
    EXPECT_NEAR(found.sd[0], period / std::sqrt(12.0), 1e-12);
    EXPECT_LT(fit.ratio_fit, 1.1);
    EXPECT_TRUE(fit.warnings.empty());
  }
}

}  // namespace
}  // namespace ambrig
