// Figures of a rotor's modes from analyses that are written down: axes that end where the reader
// needs them, colours by whirl, criticals on the line of the speed.
#include "app/figures/rotor_figures.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/math/constants.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kRpm = kPi / 30;

struct Mode {
  double at_rest, at_end;  // damped frequencies [Hz]
  double whirl = 1, zeta = 0.05, share = 1;
};

/// An analysis with these modes over the speeds from 0 to where 1X reaches `end` [Hz].
RigAnalysis With(const std::vector<Mode>& modes, double end) {
  RigAnalysis a;
  a.options.fastest = 2 * kPi * end;
  for (const Mode& m : modes) {
    ModeTrack t;
    for (const double frequency : {m.at_rest, m.at_end}) {
      ClosedLoopMode c;
      c.frequency = frequency;
      c.s = {-1, 2 * kPi * frequency};
      c.zeta = m.zeta;
      c.log_decrement = 2 * kPi * m.zeta / std::sqrt(1 - m.zeta * m.zeta);
      c.whirl = m.whirl;
      c.rotor_share = m.share;
      t.speed.push_back(t.modes.empty() ? 0 : a.options.fastest);
      t.modes.push_back(c);
    }
    a.tracks.push_back(t);
  }
  a.criticals = FindCriticals(a.tracks);
  return a;
}

double Top(const Figure& f) { return f.layout["yaxis"]["range"][1].get<double>(); }

// Bending modes at 900 and 3000 Hz do not push what 1X can meet to the bottom of the picture; the
// caption says that they are there.
TEST(CampbellFigure, EndsAboveWhatOneXCanMeet) {
  const Figure f = CampbellFigure(With({{60, 60}, {80, 95}, {900, 950}, {3000, 3000}}, 158));
  EXPECT_EQ(f.layout["yaxis"]["range"][0], 0);
  EXPECT_NEAR(Top(f), 1.3 * 158, 1e-9);
  EXPECT_THAT(f.caption, HasSubstr("2 modes lie above this axis (from 900\u00a0Hz on)"));
  EXPECT_EQ(f.layout["yaxis"]["title"]["text"], "frequency [Hz]");
}

TEST(CampbellFigure, ShowsAModeThatIsNear) {
  const Figure f = CampbellFigure(With({{60, 60}, {400, 420}}, 158));
  EXPECT_NEAR(Top(f), 1.15 * 420, 1e-9);
  EXPECT_THAT(f.caption, Not(HasSubstr("above this axis")));
}

// A rotor that hardly turns: its modes are the picture, not 1X.
TEST(CampbellFigure, OfASlowRotorShowsItsLowestModes) {
  EXPECT_NEAR(Top(CampbellFigure(With({{60, 61}, {90, 100}}, 1))), 1.15 * 100, 1e-9);
  EXPECT_GT(Top(CampbellFigure(With({}, 100))), 100);
}

TEST(CampbellFigure, OneModeAboveIsSaidInTheSingular) {
  EXPECT_THAT(CampbellFigure(With({{60, 60}, {900, 900}}, 100)).caption,
              HasSubstr("1 mode lies above this axis"));
}

// Current loops, integrators and modes that hardly swing are no lines.
TEST(CampbellFigure, LeavesOutWhatIsNoModeOfTheRotor) {
  const Figure all = CampbellFigure(With({{60, 60}}, 100)),
               same =
                   CampbellFigure(With({{60, 60}, {70, 70, 1, 0.05, 0.1}, {50, 50, 1, 0.99}}, 100));
  EXPECT_EQ(all.traces.size(), same.traces.size());
}

TEST(CampbellFigure, LinesHaveTheColourOfTheirWhirlAndOneLegendEach) {
  const Figure f = CampbellFigure(With({{60, 60, 1}, {65, 70, 1}, {55, 50, -1}, {40, 40, 0}}, 30));
  int legends = 0;
  for (const auto& trace : f.traces) {
    if (!trace.contains("line")) continue;  // dots of the critical speeds
    const std::string name = trace["name"], colour = trace["line"]["color"];
    if (name == "forward") {
      EXPECT_EQ(colour, "@blue");
    }
    if (name == "backward") {
      EXPECT_EQ(colour, "@orange");
    }
    if (name == "mixed") {
      EXPECT_EQ(colour, "@muted");
    }
    legends += name != "1X" && trace.value("showlegend", true) ? 1 : 0;
  }
  EXPECT_EQ(legends, 3);
}

// A critical speed lies on 1X: 60 Hz are 3600 rpm.
TEST(CampbellFigure, CriticalsStandOnOneX) {
  const Figure f = CampbellFigure(With({{60, 60}}, 100));
  bool line = false, dot = false;
  for (const auto& trace : f.traces) {
    if (trace["name"] == "1X") {
      line = true;
      EXPECT_NEAR(trace["x"][1].get<double>(), 6000, 0.1);
      EXPECT_NEAR(trace["y"][1].get<double>(), 100, 1e-3);
    }
    if (trace["name"] == "critical speed") {
      dot = true;
      EXPECT_NEAR(trace["x"][0].get<double>(), 3600, 0.1);
      EXPECT_NEAR(trace["y"][0].get<double>(), 60, 1e-3);
    }
  }
  EXPECT_TRUE(line);
  EXPECT_TRUE(dot);
  for (const auto& trace : CampbellFigure(With({{160, 160}}, 100)).traces)
    EXPECT_NE(trace["name"], "critical speed");
  // Nor is a crossing one that is damped too much to have a peak (0.71 of critical).
  RigAnalysis damped = With({{60, 60}}, 100);
  damped.criticals.at(0).mode.zeta = 0.75;
  for (const auto& trace : CampbellFigure(damped).traces)
    EXPECT_NE(trace["name"], "critical speed");
}

TEST(CampbellFigure, DecrementsHaveTheirLimit) {
  const Figure f = CampbellFigure(With({{60, 60, 1, 0.1}}, 100));
  EXPECT_EQ(f.layout["yaxis2"]["title"]["text"], "log decrement [-]");
  const auto& shapes = f.layout["shapes"];
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_EQ(shapes[0]["y0"], 0.1);
  EXPECT_EQ(f.layout["annotations"].back()["text"], "API 617: 0.1");
}

RigAnalysis WithMap() {
  RigAnalysis a;
  for (const double k : {1e5, 1e6, 1e7}) {
    CriticalMapRow row;
    row.stiffness = k;
    for (const double whirl : {-1.0, 1.0}) {
      CriticalSpeed c;
      c.speed = std::sqrt(k) * (whirl > 0 ? 1.1 : 1);
      c.whirl = whirl;
      row.speeds.push_back(c);
    }
    a.supports.map.push_back(row);
  }
  a.supports.supports = {{"A", 4e5, 1e5}, {"B", 1e5, 4e5}};
  return a;
}

// The stiffness of each bearing is a vertical line; a bearing without net stiffness has none.
TEST(CriticalMapFigure, ShowsSpeedsOverStiffnessAndWhereTheBearingsAre) {
  const Figure f = CriticalMapFigure(WithMap());
  EXPECT_EQ(f.layout["xaxis"]["type"], "log");
  EXPECT_EQ(f.layout["yaxis"]["type"], "log");
  ASSERT_EQ(f.traces.size(), 3u);
  EXPECT_EQ(f.traces[0]["name"], "1 backward");
  EXPECT_EQ(f.traces[1]["name"], "2 forward");
  EXPECT_EQ(f.traces[2]["name"], "A");
  EXPECT_NEAR(f.traces[2]["x"][0].get<double>(), 3e5, 1);
  EXPECT_EQ(f.traces[2]["x"][0], f.traces[2]["x"][1]);
  EXPECT_NEAR(f.traces[0]["y"][1].get<double>(), 1e3 / kRpm, 1);
  EXPECT_TRUE(CriticalMapFigure(RigAnalysis{}).traces.empty());
}

// One operating speed has no width to shade.
TEST(OperatingSpeeds, AreShadedOrALine) {
  Figure range = MakeFigure("Response."), one = MakeFigure("Response."),
         none = MakeFigure("Response.");
  MarkOperatingSpeeds(range, 3000 * kRpm, 6000 * kRpm, 9000 * kRpm);
  MarkOperatingSpeeds(one, 3000 * kRpm, 3000 * kRpm, 9000 * kRpm);
  MarkOperatingSpeeds(none, 0, 0, 9000 * kRpm);
  EXPECT_EQ(range.caption, "Response. The shaded speeds are the operating range.");
  EXPECT_EQ(one.caption, "Response. The vertical line is the operating speed.");
  EXPECT_EQ(none.caption, "Response.");
  EXPECT_EQ(range.layout["shapes"][0]["type"], "rect");
  EXPECT_EQ(one.layout["shapes"][0]["type"], "line");
  for (const char* end : {"x0", "x1"})
    EXPECT_NEAR(one.layout["shapes"][0][end].get<double>(), 3000, 1e-9);
  EXPECT_NEAR(range.layout["shapes"][0]["x1"].get<double>(), 6000, 1e-9);
  EXPECT_TRUE(none.layout["shapes"].empty());
}

}  // namespace
}  // namespace ambrig
