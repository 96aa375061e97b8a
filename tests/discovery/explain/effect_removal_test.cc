// Effects that are removed again.
#include "discovery/explain/effect_removal.h"

#include <gtest/gtest.h>

#include "tests/discovery/explain/search_parts.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

class EffectRemovalTest : public testing::SearchParts {};

TEST_F(EffectRemovalTest, AnEffectWithoutASizeIsRemovedWithAWarning) {
  EffectRemoval removal(models_, coils_, adopted_, names_, log_, progress_);
  const FitResult base = models_.FitFrom(nominal_);
  Hypothesis h = base.hypothesis;
  h.AddEffect(LinearCase::Offset(1e-8));
  FitResult now = models_.FitFrom(h);
  adopted_.AddLastOf(now);
  const EffectInstance offset = adopted_[0];
  EXPECT_TRUE(removal.DropSizeless(base, now));
  EXPECT_TRUE(adopted_.empty());
  EXPECT_TRUE(adopted_.IsSizeless(offset));
  EXPECT_FALSE(removal.DropSizeless(base, now));
  EXPECT_EQ(now.ratio_fit, base.ratio_fit);
  ASSERT_EQ(log_.warnings.size(), 1u);
  EXPECT_EQ(log_.warnings[0], "sensor-offset at A.x lies within 3 sd of nothing: it is not named");
}

// Of two effects that do the same to A.x, one is needless; the one that is left explains as much.
TEST_F(EffectRemovalTest, AnEffectThatItsSuccessorMakesNeedlessIsRemoved) {
  EffectRemoval removal(models_, coils_, adopted_, names_, log_, progress_);
  const FitResult base = models_.FitFrom(nominal_);
  Hypothesis h = base.hypothesis;
  h.AddEffect(LinearCase::Gain(1.0));
  h.AddEffect(LinearCase::Offset(1e-8));
  FitResult now = models_.FitFrom(h);
  adopted_.Take(now, 2);
  removal.DropSuperseded(base, now);
  EXPECT_EQ(adopted_.size(), 1u);
  ASSERT_EQ(log_.ladder.size(), 1u);
  EXPECT_EQ(log_.ladder[0].added, "without the effect that became needless");
  EXPECT_NEAR(now.ratio_fit, base.ratio_fit, 0.01);
}

}  // namespace
}  // namespace ambrig
