// What figures are made of: marks, regions, levels, bands, heat maps, the drawing of a stator,
// residuals.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <set>

#include "app/figures/residual_data.h"
#include "app/figures/rig_drawing.h"
#include "app/pages/html.h"
#include "tests/app/html_page.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

using testing::CountOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(FigureMarks, OutsideTheRangeAreLeftOutAndTheRestStandsInEveryPanel) {
  Grid grid;
  grid.rows = 3;
  Figure f = MakeFigure("c", grid);
  const std::vector<Mark> marks = {{-1, "before"}, {2, "first"}, {8, "second"}, {11, "after"}};
  AddMarks(f, marks, {0, 10});
  EXPECT_EQ(f.layout["shapes"].size(), 2u * 3);
  ASSERT_EQ(f.layout["annotations"].size(), 2u);
  EXPECT_EQ(f.layout["annotations"][0]["text"], "first");
  EXPECT_EQ(f.layout["annotations"][0]["xanchor"], "left");
  EXPECT_EQ(f.layout["annotations"][1]["xanchor"], "right");  // runs to the left of it
  EXPECT_EQ(f.layout["shapes"][4]["yref"], "y2 domain");
}

TEST(FigureMarks, RegionsLevelsAndTextStandWhereTheyAreSaid) {
  Figure f = MakeFigure("c");
  AddRegion(f, 0, 1, 3, "stage", "@blue/20");
  AddLevel(f, 0, 7, "limit");
  AddLevel(f, 0, 8, "");
  AddText(f, 0, 4, 5, "here");
  ASSERT_EQ(f.layout["shapes"].size(), 3u);
  EXPECT_EQ(f.layout["shapes"][0]["x0"], 1);
  EXPECT_EQ(f.layout["shapes"][0]["fillcolor"], "@blue/20");
  EXPECT_EQ(f.layout["shapes"][1]["y0"], 7);
  ASSERT_EQ(f.layout["annotations"].size(), 3u);  // a level without a name has none
  EXPECT_EQ(f.layout["annotations"][0]["x"], 2);  // in the middle of its region
  EXPECT_EQ(f.layout["annotations"][1]["text"], "limit");
  EXPECT_EQ(f.layout["annotations"][2]["y"], 5);
}

TEST(FigureMarks, ACircleIsRoundAboutItsCentre) {
  Figure f = MakeFigure("c");
  AddCircle(f, 0, 2, -1, 3, "@ink");
  const auto& s = f.layout["shapes"][0];
  EXPECT_EQ(s["x0"], -1);
  EXPECT_EQ(s["x1"], 5);
  EXPECT_EQ(s["y0"], -4);
  EXPECT_EQ(s["y1"], 2);
  EXPECT_FALSE(s.contains("fillcolor"));
}

TEST(FigureParts, AxesCarryTitlesRangesAndScale) {
  Grid grid;
  grid.rows = 2;
  Figure f = MakeFigure("c", grid);
  SetAxes(f, 0, "time [s]", "a", {{0, 5}});
  SetAxes(f, 1, "time [s]", "b", {}, {{-1, 1}});
  LogAxes(f, 1, false, true);
  EqualAspect(f, 1);
  EXPECT_FALSE(f.layout["xaxis"].contains("title"));  // only the bottom panel has the numbers
  EXPECT_EQ(f.layout["xaxis2"]["title"]["text"], "time [s]");
  EXPECT_THAT(f.layout["xaxis"]["range"], ElementsAre(0, 5));
  EXPECT_THAT(f.layout["yaxis2"]["range"], ElementsAre(-1, 1));
  EXPECT_EQ(f.layout["yaxis2"]["type"], "log");
  EXPECT_EQ(f.layout["yaxis2"]["scaleanchor"], "x2");
}

TEST(FigureParts, SeriesDifferInColourOrDash) {
  std::set<std::pair<std::string, std::string>> seen;
  for (int k = 0; k < 12; ++k)
    EXPECT_TRUE(seen.emplace(SeriesStyle(k).color, SeriesStyle(k).dash).second) << k;
}

TEST(FigureParts, AHeatmapKeepsItsNumbersAndGaps) {
  Figure f = MakeFigure("c");
  AddHeatmap(f, 0, {"a", "b"}, {"r1", "r2"}, {{1, 2.5}, {std::nan(""), 4}}, "bar", 3);
  const auto& t = f.traces.back();
  EXPECT_EQ(t["type"], "heatmap");
  EXPECT_THAT(t["x"], ElementsAre("a", "b"));
  EXPECT_THAT(t["y"], ElementsAre("r1", "r2"));
  EXPECT_EQ(t["z"][0][1], 2.5);
  EXPECT_TRUE(t["z"][1][0].is_null());
}

TEST(HtmlReportParts, MarksOfAnySeriesAreShown) {
  const std::vector<double> whole = {-2, -1, 0, 1}, late = {0, 1}, y4 = {1, 2, 3, 4}, y2 = {1, 2};
  HtmlReport r("t", "s");
  const std::vector<Mark> marks = {{-1.5, "early mark"}};
  r.TimeSeries("caption", "t [s]", "y [m]", {{"whole", whole, y4}, {"late", late, y2}}, marks);
  EXPECT_THAT(r.Html(), HasSubstr("early mark"));
  HtmlReport negative("t", "s");
  const std::vector<double> before = {-3, -2};
  const std::vector<Mark> beyond = {{-1, "beyond the end"}};
  negative.TimeSeries("caption", "t [s]", "y [m]", {{"before", before, y2}}, beyond);
  EXPECT_THAT(negative.Html(), Not(HasSubstr("beyond the end")));
}

TEST(HtmlReportParts, WhatIsGivenIsEscaped) {
  HtmlReport r("a < b", "c & d");
  r.Heading("x > y");
  r.Code("if (a < b) \"quoted\"");
  r.KeyValues({{"k<ey", "v&alue"}});
  r.BeginDetails("more <here>");
  r.EndDetails();
  const std::string html = testing::OwnMarkup(r.Html());
  for (const char* text : {"a &lt; b", "c &amp; d", "x &gt; y", "if (a &lt; b)", "k&lt;ey",
                           "v&amp;alue", "more &lt;here&gt;"})
    EXPECT_THAT(html, HasSubstr(text));
  EXPECT_THAT(html, Not(HasSubstr("<here>")));
  EXPECT_THROW(r.Heading("deep", 4), std::logic_error);
  EXPECT_THROW(r.Table({"a", "b"}, {{"one"}}), std::logic_error);
}

// The library is in a page with figures only.
TEST(HtmlReportParts, APageOfTextStaysSmall) {
  HtmlReport r("t", "s");
  r.Text("words");
  EXPECT_LT(r.Html().size(), 100'000u);
  const std::vector<double> x = {0, 1};
  r.OrbitPlot("orbit", "µm", 2, {{"A", x, x}});
  EXPECT_GT(r.Html().size(), 1'000'000u);
  EXPECT_EQ(CountOf(r.Html(), "<figure id="), 1u);
}

StatorView View(double x, std::vector<int> failed) {
  StatorView v;
  v.title = "A";
  v.bearing = "A";
  for (int j = 0; j < 8; ++j) {
    v.pole_angles.push_back((0.5 + j) * std::numbers::pi / 4);
    v.flux.push_back((j % 2 == 0 ? 1 : -1) * 5e-5);
    v.current.push_back(0.25 * j);
  }
  v.failed = std::move(failed);
  v.clearance = 2e-4;
  v.x = x;
  return v;
}

// Per pole a body twice and two coil sides; failed coils in red; poles by their polarity.
TEST(StatorDrawing, ShowsPolesCoilsAndWhatFailed) {
  const StatorView views[] = {View(0, {}), View(1e-4, {3})};
  const Figure f = StatorFigure("caption", views);
  EXPECT_EQ(f.panels, 2);
  const std::string text = f.layout.dump();
  EXPECT_EQ(CountOf(text, "\"type\":\"path\""), 2u * 8 * 4);
  EXPECT_EQ(CountOf(text, "✗ A3"), 1u);
  EXPECT_EQ(CountOf(text, "\"color\":\"@red\",\"dash\":\"dot\""), 2u);
  EXPECT_EQ(CountOf(text, "@blue/100"), 8u);
  EXPECT_EQ(CountOf(text, "@orange/100"), 8u);
  EXPECT_THAT(f.traces[1]["text"][2].get<std::string>(), HasSubstr("A3: 50"));
  EXPECT_THROW(
      {
        StatorView broken = View(0, {});
        broken.flux.pop_back();
        StatorFigure("c", {&broken, 1});
      },
      std::logic_error);
}

TEST(StatorDrawing, TheShaftMovesInProportionToTheClearance) {
  const auto centre = [](double x) {
    const StatorView view = View(x, {});
    const Figure f = StatorFigure("c", {&view, 1});
    for (const auto& s : f.layout["shapes"])
      if (s["type"] == "circle" && s.value("fillcolor", "") == "@gray/30")
        return 0.5 * (s["x0"].get<double>() + s["x1"].get<double>());
    return std::nan("");
  };
  EXPECT_EQ(centre(0), 0);
  EXPECT_NEAR(centre(2e-4), 2 * centre(1e-4), 1e-12);
  EXPECT_GT(centre(1e-4), 0);
}

class ResidualData : public ::testing::Test {
 protected:
  Case case_ = MeasuredCase({{2e-5, 1e-5}, {-4e-5, 3e-5, 1, 3e-6}});
};

TEST_F(ResidualData, AViewHoldsMeasurementModelAndError) {
  case_.records[0].quality[1].ok[5] = 0;
  CaseModel model(case_);
  const std::vector<double> predicted(model.size(), 1e-5);
  const ChannelView v = ViewOf(model, predicted, model.targets()[1]);
  EXPECT_EQ(v.channel, "A.y");
  EXPECT_EQ(v.record, "record-1");
  EXPECT_EQ(v.rate, 12500);
  EXPECT_NEAR(v.t[10], 10 / 12500.0, 1e-12);
  EXPECT_TRUE(std::isnan(v.measured[5]) && std::isnan(v.residual[5]));
  EXPECT_NEAR(v.residual[6], v.measured[6] - 1e-5, 1e-18);
  EXPECT_EQ(Filled(v.residual)[5], 0);
}

// Of a kind no more than asked; none at the noise save the worst.
TEST_F(ResidualData, TheWorstChannelsComeFirst) {
  CaseModel model(case_);
  std::vector<double> residual(model.size(), 0.9);
  const double size[] = {5, 3, 4, 0.5};  // A.x, A.y, B.x, B.y of record 1
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t k = 0; k < model.targets()[t].count; ++k)
      residual[model.targets()[t].first + k] = size[t];
  const auto names = [&](std::size_t record, std::size_t count, std::size_t per_kind) {
    std::vector<std::string> out;
    for (const Target& t : WorstTargets(model, residual, record, count, per_kind))
      out.push_back(ChannelName(model, t));
    return out;
  };
  EXPECT_THAT(names(0, 4, 9), ElementsAre("A.x", "B.x", "A.y"));
  EXPECT_THAT(names(0, 4, 2), ElementsAre("A.x", "B.x"));
  EXPECT_THAT(names(0, 1, 9), ElementsAre("A.x"));
  EXPECT_EQ(names(1, 4, 9).size(), 1u);  // all at 0.9 of the noise
}

}  // namespace
}  // namespace ambrig
