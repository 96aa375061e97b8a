// Events that came, went or moved; the k-th of a kind is compared with the k-th.
#include "app/json/event_difference.h"

#include <gtest/gtest.h>

namespace ambrig {
namespace {

nlohmann::json Event(double t, const char* kind, const char* target) {
  return {{"t", t}, {"kind", kind}, {"target", target}};
}

TEST(EventDifference, CameWentMoved) {
  using Kind = EventDifference::Kind;
  const nlohmann::json a{Event(0.1, "fault", "A.coil1"), Event(0.2, "touchdown", "A"),
                         Event(0.3, "touchdown", "A"), Event(0.4, "drop", "A")};
  const nlohmann::json b{Event(0.1, "fault", "A.coil1"), Event(0.25, "touchdown", "A"),
                         Event(0.3, "touchdown", "A"), Event(0.05, "touchdown", "B")};
  const auto d = CompareEvents(a, b, 1e-3);
  ASSERT_EQ(d.size(), 3U);
  EXPECT_EQ(d[0].kind, Kind::kCame);
  EXPECT_EQ(d[0].event, "touchdown B");
  EXPECT_EQ(d[1].kind, Kind::kMoved);
  EXPECT_DOUBLE_EQ(d[1].before, 0.2);
  EXPECT_DOUBLE_EQ(d[1].after, 0.25);
  EXPECT_EQ(d[2].kind, Kind::kWent);
  EXPECT_EQ(d[2].event, "drop A");
  EXPECT_TRUE(CompareEvents(a, a, 0).empty());
  EXPECT_EQ(CompareEvents(a, b, 0.1).size(), 2U);
  EXPECT_EQ(EventDifferenceText(d[1]), "touchdown A moved from 200 ms to 250 ms");
}

}  // namespace
}  // namespace ambrig
