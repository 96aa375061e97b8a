// Marked instants of a run: faults at one instant share a mark, labels stay clear of the panels'
// titles, and a run past its poles ends its curves.
#include <gmock/gmock.h>

#include <cmath>

#include "app/figures/run_figures.h"
#include "app/pages/run_report_data.h"
#include "app/text/format.h"
#include "tests/actuators/magnetics/reference_lanes.h"
#include "tests/app/demo_run.h"
#include "tests/app/html_page.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

RunReportData WithFaults(int count, double apart) {
  RunReportData d = demo::Run();
  d.events.clear();
  for (int k = 0; k < count; ++k)
    d.events.push_back({0.5 + apart * k, "fault", "A" + std::to_string(k + 1), "open"});
  return d;
}

std::vector<std::string> Labels(const RunReportData& d) {
  std::vector<std::string> out;
  for (const Mark& m : EventMarks(d)) out.push_back(m.label);
  return out;
}

TEST(FaultMarks, AtOneInstantAreOne) {
  EXPECT_THAT(Labels(WithFaults(1, 0)), ::testing::ElementsAre("fault A1"));
  EXPECT_THAT(Labels(WithFaults(3, 0)), ::testing::ElementsAre("faults A1, A2, A3"));
  EXPECT_THAT(Labels(WithFaults(4, 0)), ::testing::ElementsAre("4 faults"));
  EXPECT_THAT(Labels(WithFaults(16, 0)), ::testing::ElementsAre("16 faults"));
}

TEST(FaultMarks, OneAfterTheOtherStayApart) {
  EXPECT_THAT(Labels(WithFaults(3, 1e-3)),
              ::testing::ElementsAre("fault A1", "fault A2", "fault A3"));
  RunReportData d = WithFaults(2, 0);
  d.events.push_back({0.6, "detected", "A1", ""});
  d.events.push_back({0.7, "fault", "B1", "open"});
  EXPECT_THAT(Labels(d), ::testing::ElementsAre("faults A1, A2", "detected", "fault B1"));
}

// A mark near the left would stand on the panel's title: its label goes a line higher.
TEST(MarkLabels, StayClearOfTheTitle) {
  const auto levels = [](const std::vector<Mark>& marks) {
    Figure f = MakeFigure("c");
    AddMarks(f, marks, {0, 10});
    std::vector<int> out;
    for (const auto& note : f.layout["annotations"]) out.push_back(note["yshift"].get<int>());
    return out;
  };
  EXPECT_THAT(levels({{0.5, "fault"}}), ::testing::ElementsAre(13));
  EXPECT_THAT(levels({{0.5, "fault"}, {3, "drop"}}), ::testing::ElementsAre(13, 0));
  EXPECT_THAT(levels({{4, "fault"}, {8, "drop"}}), ::testing::ElementsAre(0, 13));
}

/// A run whose shaft leaves its bearings at 0.3 s of 0.5 s.
class PastThePoles : public ::testing::Test {
 protected:
  PastThePoles() {
    rig_ = ReferenceLanesRig();
    rig_.file = folder_.File("rig.toml");
    scenario_.file = folder_.File("s.toml");
    scenario_.name = "falls";
    testing::WriteBytes(rig_.file, "rig");
    testing::WriteBytes(scenario_.file, "scenario");
    result_.record.rate = 1000;
    for (const char* name : {"A.r.x", "A.r.y", "B.r.x", "B.r.y"}) {
      Channel c{name, "m", std::vector<double>(500)};
      for (std::size_t k = 0; k < 500; ++k)
        c.samples[k] = k <= 300 ? 1e-6 * static_cast<double>(k) : 0.05;
      result_.record.channels.push_back(c);
    }
    for (const char* bearing : {"A", "B"})
      for (int coil = 1; coil <= 8; ++coil)
        result_.record.channels.push_back(
            {std::string(bearing) + ".i" + std::to_string(coil), "A", std::vector<double>(500, 0)});
    for (const char* name : {"omega", "bus"})
      result_.record.channels.push_back({name, "", std::vector<double>(500, 1)});
    result_.drop = true;
    result_.events = {{0.25, "drop", "A", "", 0}, {0.3, "model_invalid", "B", "", 0}};
    result_.notes = {"past the poles of B from t = 0.3000 s: the model is invalid after"};
    result_.metrics.max_orbit = {{"A", 4e-4}, {"B", 4e-4}};
  }
  RunReportData Data() const {
    return MakeRunReportData(rig_, scenario_, result_, {}, "switching");
  }
  testing::TemporaryFolder folder_;
  RigParameters rig_;
  Scenario scenario_;
  RunResult result_;
};

TEST_F(PastThePoles, PathsEndThere) {
  EXPECT_EQ(ModelEnd(result_), 0.3);
  const RunReportData d = Data();
  for (const ReportBearing& b : d.bearings)
    for (const std::vector<double>* path : {&b.x, &b.y}) {
      ASSERT_EQ(path->size(), 500u);
      EXPECT_EQ((*path)[300], 3e-4);
      EXPECT_TRUE(std::isnan((*path)[301]));
      EXPECT_TRUE(std::isnan((*path)[499]));
    }
  result_.events.pop_back();
  EXPECT_TRUE(std::isinf(ModelEnd(result_)));
  EXPECT_EQ(Data().bearings[0].x[499], 0.05);
}

TEST_F(PastThePoles, StationsToo) {
  rig_.stations = {{"disk", 0.01}};
  result_.record.channels.push_back({"disk.r.x", "m", result_.record.Find("A.r.x")->samples});
  result_.record.channels.push_back({"disk.r.y", "m", std::vector<double>(500, 0)});
  const auto orbits = StationOrbits(rig_, result_);
  ASSERT_EQ(orbits.size(), 1u);
  EXPECT_NEAR(orbits.at("disk"), 3e-4, 1e-12);
}

// The page says it in words, beside the verdict, and draws nothing beyond the gap.
TEST_F(PastThePoles, ThePageSaysSo) {
  const std::string html = MakeRunReport(Data()).Html(), words = testing::Words(html);
  EXPECT_THAT(words, HasSubstr("The rotor dropped."));
  EXPECT_THAT(words,
              HasSubstr("Past the poles of B from t = 0.3000 s: the model is invalid after."));
  EXPECT_THAT(html, HasSubstr("model invalid"));
  const Figure f = OrbitFigure(Data(), FindStages(Data()));
  for (const auto& trace : f.traces)
    for (const auto& x : trace["x"])
      if (x.is_number()) {
        EXPECT_LE(std::abs(x.get<double>()), 300.01);
      }
}

TEST(RunNotes, StandBesideTheVerdict) {
  RunReportData d = demo::Run();
  EXPECT_THAT(testing::Words(MakeRunReport(d).Html()), Not(HasSubstr("something to know")));
  d.notes = {"something to know"};
  EXPECT_THAT(testing::Words(MakeRunReport(d).Html()), HasSubstr("something to know"));
}

// What was not measured has no unit.
TEST(Format, NothingMeasuredIsADash) {
  EXPECT_EQ(FormatSi(std::nan(""), "s"), "–");
  EXPECT_EQ(FormatSi(std::nan(""), "rpm"), "–");
  EXPECT_EQ(FormatSi(0, "s"), "0\u00a0s");
}

// Small numbers with an exponent stand right-aligned like their neighbours.
TEST(TableCells, NumbersWithExponentsAreNumbers) {
  HtmlReport r("t", "s");
  r.Table({"a"}, {{"6.78e-05"}, {"1e+06 Hz"}, {"0.5"}, {"3e"}, {"1e-"}, {"2e-3x"}});
  const std::string html = r.Html();
  for (const char* number : {"6.78e-05", "1e+06 Hz", "0.5"})
    EXPECT_THAT(html, HasSubstr(std::string("<td class=\" num\">") + number + "</td>"));
  for (const char* word : {"3e", "2e-3x"})
    EXPECT_THAT(html, HasSubstr(std::string("<td class=\" \">") + word + "</td>"));
}

// What was not measured stands below the numbers of its column, and on the left among words.
TEST(TableCells, ADashStandsBelowItsNumbers) {
  HtmlReport r("t", "s");
  r.Table({"a", "b"}, {{"6.7", "held"}, {"-", "–"}});
  EXPECT_THAT(r.Html(), HasSubstr("<td class=\" num\">-</td><td class=\" \">–</td>"));
}

// A verdict in a wide table is not broken inside a word.
TEST(TableCells, VerdictsOfWideTablesAreWhole) {
  HtmlReport r("t", "s");
  EXPECT_THAT(r.Html(), ::testing::ContainsRegex(
                            "td.ok, .table.wide td.warn, .table.wide td.fail . overflow-wrap: "
                            "break-word"));
}

}  // namespace
}  // namespace ambrig
