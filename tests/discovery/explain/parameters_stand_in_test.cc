// An effect that rig parameters could stand in for is named where they would have to move far.
#include <gtest/gtest.h>

#include "effects/catalogue.h"
#include "tests/discovery/examined_records.h"

namespace ambrig {
namespace {

// An iron path of 0.03 mm acts as a gap that is longer by more than seven of its sd.
TEST(ParametersStandIn, TheReluctanceOfTheIronIsNoLongerGap) {
  EffectInstance iron = MakeInstance(EffectNamed("iron-reluctance"), "A");
  iron.Set("path", 3e-5);
  const Case c = ExaminedRecords(
      kReferenceFile, {"steps of reference and load at rest", "clamped, current ramps"}, {{iron}});
  const Explanation e = Explain(c, ShortSearch());
  EXPECT_EQ(ToText(e.verdict), std::string("effect"));
  ASSERT_FALSE(e.adopted.empty());
  EXPECT_EQ(Named(e.adopted[0]), "iron-reluctance at A");
  EXPECT_NEAR(e.adopted[0].Value("path"), 3e-5, 6e-6);
}

}  // namespace
}  // namespace ambrig
