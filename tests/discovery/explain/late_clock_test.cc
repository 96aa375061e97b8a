// A logger that starts one row late in one record: told as such, not fitted by effects.
#include <gmock/gmock.h>

#include "discovery/data/clock_shift.h"
#include "tests/discovery/examined_records.h"

namespace ambrig {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST(LateClock, OfOneRecordIsSetRight) {
  const Case healthy = ExaminedRecords(
      kReferenceFile,
      {"steps of reference and load at rest", "multisine at rest", "clamped, current ramps"});
  // every row shows what was one row before
  const Case c = WithClocks(healthy, {-1 / healthy.records[0].data.rate, 0, 0});
  const Explanation e = Explain(c, ShortSearch());
  EXPECT_THAT(e.warnings, Contains(HasSubstr("is 1 row late")));
  EXPECT_TRUE(e.adopted.empty());
  EXPECT_NE(e.verdict, ExplanationVerdict::kUnknown);
  EXPECT_LT(e.final_ratio_fit, 1.05);
}

}  // namespace
}  // namespace ambrig
