// An offset of one sensor that is written down: adopted by the first round, and then nothing is
// left.
#include "discovery/explain/effect_selection.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/discovery/explain/search_parts.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

class OffsetOfOneSensor : public testing::SearchParts {
 protected:
  OffsetOfOneSensor() : SearchParts(testing::FourPlaces(1, {3e-6, 3e-6, 3e-6, 3e-6})) {}
};

TEST_F(OffsetOfOneSensor, IsAdoptedAndLeavesNothing) {
  int adoptions = 0;
  EffectSelection selection(models_, nuisances_, coils_, adopted_, names_, log_, progress_,
                            options_, [&] { ++adoptions; });
  FitResult now = models_.FitFrom(nominal_);
  EXPECT_FALSE(selection.Finished(now));
  EXPECT_TRUE(selection.AdoptMore(now));
  ASSERT_EQ(adopted_.size(), 1u);
  EXPECT_EQ(Named(adopted_[0]), "sensor-offset at A.x");
  EXPECT_NEAR(adopted_[0].Value("offset"), 3e-6, 2e-7);
  EXPECT_EQ(adoptions, 1);
  EXPECT_TRUE(selection.Finished(now));
  ASSERT_EQ(log_.ladder.size(), 1u);
  EXPECT_EQ(log_.ladder[0].added, "sensor-offset at A.x");
  EXPECT_FALSE(names_.first().empty());
  EXPECT_FALSE(names_.screened().empty());
  EXPECT_GT(adopted_.first_fall, 1);
}

// What a last fit left without a size gives its place to the next in the ranking.
TEST_F(OffsetOfOneSensor, IsNotAdoptedOnceItHadNoSize) {
  EffectSelection selection(models_, nuisances_, coils_, adopted_, names_, log_, progress_,
                            options_, [] {});
  adopted_.NoteSizeless(LinearCase::Offset(3e-6));
  FitResult now = models_.FitFrom(nominal_);
  selection.AdoptMore(now);
  ASSERT_FALSE(names_.first().empty());
  EXPECT_EQ(Named(names_.first()[0].effect), "sensor-offset at A.x");
  for (const EffectInstance& e : adopted_.all()) EXPECT_NE(Named(e), "sensor-offset at A.x");
}

}  // namespace
}  // namespace ambrig
