// Events that came, went or moved; one more in front does not move those behind it.
#include "app/json/event_difference.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/errors.h"
#include "tests/core/temporary_folder.h"

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

nlohmann::json Touches(const std::vector<double>& times) {
  nlohmann::json out = nlohmann::json::array();
  for (const double t : times) out.push_back(Event(t, "touchdown", "A"));
  return out;
}

// A contact more among many, in front, within or behind: one event is new, none moved.
TEST(EventDifference, OneMoreIsOneMore) {
  using Kind = EventDifference::Kind;
  std::vector<double> times;
  for (int k = 0; k < 50; ++k) times.push_back(0.1 + 0.01 * k);
  for (const double more : {0.05, 0.333, 0.9}) {
    std::vector<double> longer = times;
    longer.insert(std::upper_bound(longer.begin(), longer.end(), more), more);
    const auto came = CompareEvents(Touches(times), Touches(longer), 0);
    ASSERT_EQ(came.size(), 1U) << more;
    EXPECT_EQ(came[0].kind, Kind::kCame);
    EXPECT_EQ(came[0].after, more);
    const auto went = CompareEvents(Touches(longer), Touches(times), 0);
    ASSERT_EQ(went.size(), 1U) << more;
    EXPECT_EQ(went[0].kind, Kind::kWent);
    EXPECT_EQ(went[0].before, more);
  }
  // Two more and one that moved.
  const auto d = CompareEvents(Touches({0.1, 0.2, 0.3}), Touches({0.05, 0.1, 0.21, 0.25, 0.3}), 0);
  ASSERT_EQ(d.size(), 3U);
  EXPECT_EQ(d[0].after, 0.05);
  EXPECT_EQ(d[1].kind, Kind::kMoved);
  EXPECT_EQ(d[1].before, 0.2);
  EXPECT_EQ(d[1].after, 0.21);
  EXPECT_EQ(d[2].after, 0.25);
}

// Before, the first of these ended `diff` with exit code 3.
TEST(EventDifference, WhatIsNoEventIsRefused) {
  const auto refusal = [](const char* text) {
    return testing::ErrorText<InputError>(
        [&] { CheckEvents(nlohmann::json::parse(text), "a.json"); });
  };
  for (const char* text : {"[{}, 1]", "[{}, null]", R"([{}, {"t": "x"}])", R"([{}, {"kind": 1}])",
                           R"([{}, {"target": []}])", R"([{}, {"class": {}}])"})
    EXPECT_EQ(refusal(text),
              "a.json: events[1] is no event of a run, allowed: objects with a number t and texts "
              "kind, target, class")
        << text;
  EXPECT_EQ(refusal(R"([{"t": 1, "kind": "alarm", "target": "A.coil1", "class": "open"}, {}])"),
            "");
}

}  // namespace
}  // namespace ambrig
