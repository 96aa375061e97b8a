// Two runs side by side as lines, JSON and page.
#include <gmock/gmock.h>

#include <cmath>

#include "app/pages/difference_report.h"
#include "tests/app/html_page.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

RunFiles StoredRun(const std::string& file) {
  RunFiles r;
  r.file = file;
  r.record.rate = 1000;
  Channel x{"A.x", "m", {}}, i{"A.i1", "A", {}};
  for (int k = 0; k < 100; ++k) {
    x.samples.push_back(1e-5 * std::sin(0.1 * k));
    i.samples.push_back(2 + 0.1 * std::cos(0.1 * k));
  }
  r.record.channels = {x, i};
  r.events = nlohmann::json::parse(R"([{"t": 0.02, "kind": "detected", "target": "A.coil3"}])");
  return r;
}

RunDifference Compared(const RunFiles& a, const RunFiles& b, double allowed = 0) {
  RecordTolerances t;
  t.all.absolute = allowed;
  return CompareRuns(a, b, t);
}

std::string DifferencePage(const RunFiles& a, const RunFiles& b, const RunDifference& d) {
  return testing::Written([&](const std::string& path) {
    WriteDifferenceReport({{"run 7", &a, &b, &d}}, path);
  });
}

TEST(DifferencePage, EqualRunsHaveNothingToShow) {
  const RunFiles a = StoredRun("old.h5"), b = StoredRun("new.h5");
  const RunDifference d = Compared(a, b);
  EXPECT_TRUE(d.identical());
  EXPECT_THAT(DifferenceLines(d), IsEmpty());
  const std::string page = DifferencePage(a, b, d), words = testing::Words(page);
  EXPECT_THAT(words, HasSubstr("No bit differs."));
  EXPECT_THAT(words, HasSubstr("old.h5 and new.h5"));
  EXPECT_EQ(testing::CountOf(page, "<figure id="), 0u);
  const auto json = DifferenceJson(d);
  EXPECT_EQ(json["identical"], true);
  EXPECT_TRUE(json["first"].is_null());
  EXPECT_EQ(json["channels"].size(), 2u);
}

// The current leaves at 40 ms, the position at 60 ms; an event moved and one came.
TEST(DifferencePage, TheFirstChannelToLeaveComesFirst) {
  const RunFiles a = StoredRun("old.h5");
  RunFiles b = StoredRun("new.h5");
  for (std::size_t k = 60; k < 100; ++k) b.record.channels[0].samples[k] += 3e-6;
  for (std::size_t k = 40; k < 100; ++k) b.record.channels[1].samples[k] += 0.25;
  b.events[0]["t"] = 0.021;
  b.events.push_back({{"t", 0.05}, {"kind", "touchdown"}, {"target", "A"}});
  const RunDifference d = Compared(a, b, 1e-9);
  EXPECT_FALSE(d.agrees());
  const std::vector<std::string> lines = DifferenceLines(d);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "first: A.i1 at 40 ms");
  EXPECT_THAT(lines[1], HasSubstr("detected A.coil3 moved from 20 ms to 21 ms"));
  EXPECT_THAT(lines[2], HasSubstr("touchdown A"));
  EXPECT_THAT(lines[3], HasSubstr("A.i1: differs from 40 ms, 60 of 100 rows, worst 250 mA"));
  EXPECT_THAT(lines[4], HasSubstr("A.x: differs from 60 ms, 40 of 100 rows, worst 3 um"));
  EXPECT_THAT(lines[4], HasSubstr("(allowed 1 nm)"));
  EXPECT_EQ(DifferenceLines(d, 1).back(), "and 1 more channel");
  const std::string page = DifferencePage(a, b, d), words = testing::Words(page);
  EXPECT_THAT(words, HasSubstr("Something differs beyond the tolerances."));
  EXPECT_THAT(words, HasSubstr("60 of 100"));
  EXPECT_EQ(testing::CountOf(page, "<figure id="), 2u);
  EXPECT_THAT(page, HasSubstr("now less before [mA]"));  // of 250 mA, which both curves may hide
  EXPECT_LT(page.find("A.i1: differs from 40 ms on,"), page.find("A.x: differs from 60 ms on,"));
  const auto json = DifferenceJson(d);
  EXPECT_EQ(json["first"]["channel"], "A.i1");
  EXPECT_NEAR(json["first"]["t"].get<double>(), 0.04, 1e-12);
  EXPECT_EQ(json["events"][0]["kind"], "moved");
  EXPECT_EQ(json["events"][1]["kind"], "came");
  EXPECT_FALSE(json["events"][1].contains("before"));
  EXPECT_NEAR(json["channels"][0]["worst"].get<double>(), 3e-6, 1e-12);
  EXPECT_EQ(json["channels"][1]["beyond"], 60);
}

// A run that bounces has events by the hundred: as many are named as channels.
TEST(DifferencePage, ManyEventsAreCounted) {
  const RunFiles a = StoredRun("old.h5");
  RunFiles b = StoredRun("new.h5");
  for (int k = 0; k < 7; ++k)
    b.events.push_back({{"t", 0.05 + 0.001 * k}, {"kind", "touchdown"}, {"target", "A"}});
  const std::vector<std::string> lines = DifferenceLines(Compared(a, b), 3);
  EXPECT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines.back(), "and 4 more events");
}

TEST(DifferencePage, WithinTheTolerancesItAgreesButIsNotTheSame) {
  const RunFiles a = StoredRun("old.h5");
  RunFiles b = StoredRun("new.h5");
  b.record.channels[0].samples[10] += 1e-9;
  const RunDifference d = Compared(a, b, 1e-8);
  EXPECT_TRUE(d.agrees());
  EXPECT_FALSE(d.identical());
  EXPECT_THAT(testing::Words(DifferencePage(a, b, d)),
              HasSubstr("Everything is within the tolerances."));
}

TEST(DifferencePage, ALostChannelIsNamedWithoutNumbers) {
  const RunFiles a = StoredRun("old.h5");
  RunFiles b = StoredRun("new.h5");
  b.record.channels.pop_back();
  b.events = nullptr;
  const RunDifference d = Compared(a, b);
  EXPECT_FALSE(d.events_known);
  EXPECT_THAT(DifferenceLines(d), ::testing::Contains("A.i1: lost"));
  EXPECT_EQ(DifferenceJson(d)["events_compared"], false);
  EXPECT_THAT(testing::Words(DifferencePage(a, b, d)), HasSubstr("A.i1: lost."));
}

}  // namespace
}  // namespace ambrig
