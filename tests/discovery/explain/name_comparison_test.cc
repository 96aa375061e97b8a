// A gain that was adopted under the name of an offset.
#include "discovery/explain/name_comparison.h"

#include <gtest/gtest.h>

#include "tests/discovery/explain/search_parts.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

class GainCalledOffset : public testing::SearchParts {
 protected:
  GainCalledOffset() : SearchParts(testing::FourPlaces(1.08, {0, 0, 0, 0})) {}
};

TEST_F(GainCalledOffset, IsNamedGainWhereBothAreCompared) {
  const FitResult base = models_.FitFrom(nominal_);
  Hypothesis h = base.hypothesis;
  h.AddEffect(LinearCase::Offset(1e-6));
  FitResult now = models_.FitFrom(h);
  adopted_.AddLastOf(now);
  RankedEffect offset, gain;
  offset.effect = adopted_[0];
  offset.fit = now;
  offset.probability = 0.6;
  gain.effect = LinearCase::Gain(1.02);
  gain.fit = now;
  gain.probability = 0.4;
  names_.NoteRound(0, {offset, gain});
  NameComparison comparison(models_, adopted_, names_, log_, progress_, options_.candidates);
  const FitResult before = now;
  comparison.Compare(base, now);  // its round has judged the only name
  EXPECT_EQ(Named(adopted_[0]), "sensor-offset at A.x");
  comparison.Compare(base, now, NameComparison::Names::kAllAgain);
  ASSERT_EQ(adopted_.size(), 1u);
  EXPECT_EQ(Named(adopted_[0]), "sensor-gain at A.x");
  EXPECT_NEAR(adopted_[0].Value("gain"), 1.08, 5e-3);
  EXPECT_LT(now.ratio_fit, 0.5 * before.ratio_fit);
  ASSERT_EQ(log_.ladder.size(), 1u);
  EXPECT_EQ(log_.ladder[0].added, "sensor-gain at A.x in place of sensor-offset at A.x");
  ASSERT_FALSE(names_.first().empty());
  EXPECT_EQ(Named(names_.first()[0].effect), "sensor-gain at A.x");
}

}  // namespace
}  // namespace ambrig
