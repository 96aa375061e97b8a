// Records whose clock is off: their rows are moved back.
#include "discovery/data/clock_shift.h"

#include <gmock/gmock.h>

#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using ::testing::IsNan;

Case OfFourRows() {
  Case c;
  CaseRecord r;
  r.data.rate = 1000;
  r.data.channels.push_back({"A.x", "m", {1, 2, 3, 4}});
  r.quality.push_back({"A.x", "good", true, {1, 0, 1, 1}, 0, 0});
  c.records = {r, r, r};
  return c;
}

TEST(ClockShift, RowsComeBackAndTheEdgeIsMissing) {
  const Case c = WithClocks(OfFourRows(), {1e-3, -2e-3, 0});
  EXPECT_THAT(c.records[0].data.channels[0].samples, ElementsAre(2, 3, 4, IsNan()));
  EXPECT_THAT(c.records[0].quality[0].ok, ElementsAre(0, 1, 1, 0));
  EXPECT_THAT(c.records[1].data.channels[0].samples, ElementsAre(IsNan(), IsNan(), 1, 2));
  EXPECT_THAT(c.records[1].quality[0].ok, ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(c.records[2].data.channels[0].samples, ElementsAre(1, 2, 3, 4));
}

// 1.25 rows late: two rows go, and the first of the rest was measured 0.75 of a row later.
TEST(ClockShift, APartOfARowIsALaterStart) {
  const Case c = WithClocks(OfFourRows(), {1.25e-3, -1.25e-3, 0.5e-3});
  EXPECT_THAT(c.records[0].data.channels[0].samples, ElementsAre(3, 4, IsNan(), IsNan()));
  EXPECT_NEAR(c.records[0].data.start, 0.75e-3, 1e-15);
  EXPECT_THAT(c.records[1].data.channels[0].samples, ElementsAre(IsNan(), 1, 2, 3));
  EXPECT_NEAR(c.records[1].data.start, 0.25e-3, 1e-15);
  EXPECT_THAT(c.records[2].data.channels[0].samples, ElementsAre(2, 3, 4, IsNan()));
  EXPECT_NEAR(c.records[2].data.start, 0.5e-3, 1e-15);
}

TEST(ClockShift, MoreRowsThanThereAreLeaveNothing) {
  const Case c = WithClocks(OfFourRows(), {9e-3, -9e-3, 0});
  EXPECT_THAT(c.records[0].quality[0].ok, ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(c.records[1].quality[0].ok, ElementsAre(0, 0, 0, 0));
}

}  // namespace
}  // namespace ambrig
