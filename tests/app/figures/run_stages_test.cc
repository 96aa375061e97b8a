// Where a run is cut for pictures, and which of its events are marked.
#include <gmock/gmock.h>

#include "app/figures/run_figures.h"

namespace ambrig {
namespace {

RunReportData Data(std::vector<ReportEvent> events) {
  RunReportData d;
  d.rate = 1000;
  d.start = 0.5;
  ReportBearing b;
  b.name = "A";
  b.x.assign(1001, 0.0);  // to 1.5 s
  b.y = b.x;
  d.bearings = {b};
  d.events = std::move(events);
  return d;
}

TEST(RunStages, OfAHealthyRunAreTheWhole) {
  const RunStages s = FindStages(Data({{0.7, "touchdown", "A", ""}}));
  EXPECT_EQ(s.whole[0], 0.5);
  EXPECT_NEAR(s.whole[1], 1.5, 1e-12);
  EXPECT_FALSE(s.fault || s.reaction);
}

TEST(RunStages, RunFromTheFirstFaultToItsLastReaction) {
  const RunStages s = FindStages(Data({{0.8, "fault", "A3", "open"},
                                       {0.801, "detected", "A3", ""},
                                       {0.804, "redistributed", "A", ""},
                                       {1.0, "fault", "B1", "open"},
                                       {1.001, "redistributed", "B", ""}}));
  EXPECT_EQ(s.fault, 0.8);
  EXPECT_EQ(s.coil, "A3");
  EXPECT_EQ(s.reaction, 0.804);  // the second fault's is another
  EXPECT_NEAR(s.window[0], 0.8 - 0.3 * 0.016, 1e-12);
  EXPECT_NEAR(s.window[1], 0.8 + 0.016, 1e-12);  // four times the reaction
}

// What could not be done about a fault ends the reaction as well as what was.
TEST(RunStages, TheReactionMayBeThatNothingIsRedistributed) {
  const RunStages s = FindStages(Data({{0.8, "fault", "A3", "open"},
                                       {0.801, "classified", "A3", "open"},
                                       {0.804, "not_redistributed", "A", "none"}}));
  EXPECT_EQ(s.reaction, 0.804);
}

TEST(RunStages, TheWindowStaysInsideTheRun) {
  const RunStages early = FindStages(Data({{0.501, "fault", "A3", ""}}));
  EXPECT_EQ(early.window[0], 0.5);
  EXPECT_NEAR(early.window[1], 0.513, 1e-12);  // 12 ms where nothing reacts
  const RunStages late = FindStages(Data({{1.495, "fault", "A3", ""}}));
  EXPECT_NEAR(late.window[1], 1.5, 1e-12);
}

TEST(EventMarks, AreNamedAndScaled) {
  const std::vector<Mark> marks =
      EventMarks(Data({{0.8, "fault", "A3", "open"}, {0.9, "alarm_cleared", "A", ""}}), 0.8, 1e3);
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_EQ(marks[0].label, "fault A3");
  EXPECT_NEAR(marks[0].x, 0, 1e-9);
  EXPECT_EQ(marks[1].label, "alarm cleared");
  EXPECT_NEAR(marks[1].x, 100, 1e-9);
  EXPECT_NE(marks[0].color, marks[1].color);
}

TEST(EventMarks, OfABouncingRotorAreFew) {
  std::vector<ReportEvent> events;
  for (int k = 0; k < 40; ++k)
    events.push_back({0.6 + 0.01 * k, k % 2 == 0 ? "touchdown" : "lift_off", "A", ""});
  events.push_back({1.2, "drop", "A", ""});
  const std::vector<Mark> marks = EventMarks(Data(events));
  EXPECT_EQ(marks.size(), 7u);
  EXPECT_EQ(marks.back().label, "drop");
}

TEST(StageFigure, ShowsTheFaultyCoilOrNothing) {
  RunReportData d = Data({});
  EXPECT_FALSE(StageFigure(d, FindStages(d)));
  d.events = {{0.8, "fault", "A3", "open"}, {0.801, "redistributed", "A", ""}};
  d.bearings[0].currents.assign(8, std::vector<double>(1001, 1.5));
  const auto f = StageFigure(d, FindStages(d));
  ASSERT_TRUE(f);
  EXPECT_FALSE(f->traces.empty());
}

// A clamped shaft has no orbit: its coils have their stages all the same.
TEST(StageFigure, OfAClampedShaftRunsOverItsCurrents) {
  RunReportData d = Data({{0.8, "fault", "A3", "open"}});
  d.bearings[0].x.clear();
  d.bearings[0].y.clear();
  d.bearings[0].currents.assign(8, std::vector<double>(1001, 1.5));
  EXPECT_NEAR(FindStages(d).whole[1], 1.5, 1e-12);
  EXPECT_TRUE(StageFigure(d, FindStages(d)));
}

}  // namespace
}  // namespace ambrig
