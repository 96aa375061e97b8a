// Figures of the closed loops from numbers that are written down: what is drawn, and in what unit.
#include "app/figures/loop_figures.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/math/constants.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;
using ::testing::HasSubstr;
using Json = nlohmann::json;

/// The values of the trace of this name; of the panel's axis where it is given ("y2").
const Json& TraceOf(const Figure& f, const std::string& name, const std::string& axis = "") {
  static const Json none;
  for (const Json& t : f.traces)
    if (t.value("name", "") == name && (axis.empty() || t.value("yaxis", "y") == axis)) return t;
  ADD_FAILURE() << "no trace " << name << " in " << f.traces.dump();
  return none;
}

RigAnalysis WithSensitivity(double peak) {
  RigAnalysis a;
  for (const double speed : {0.0, 100 * kPi}) {  // at rest, 3000 rpm
    Sensitivity s;
    s.speed = speed;
    s.frequency = {10, 100, 1000};
    s.axes.emplace_back();
    s.axes[0].axis = "A.x";
    s.axes[0].S = {{0.1, 0}, {0, -peak}, {1, 0}};
    s.axes[0].peak = peak;
    a.sensitivity.push_back(s);
  }
  return a;
}

TEST(SensitivityFigure, MagnitudesStandInOnePanelPerSpeedUnderTheZonesTheyReach) {
  const Figure f = SensitivityFigure(WithSensitivity(3.5));
  EXPECT_EQ(f.panels, 2);
  EXPECT_EQ(TraceOf(f, "A.x", "y")["y"], Json({0.1, 3.5, 1}));
  EXPECT_EQ(TraceOf(f, "A.x", "y2")["y"], Json({0.1, 3.5, 1}));
  const std::string layout = f.layout.dump();
  EXPECT_THAT(layout, HasSubstr("at rest"));
  EXPECT_THAT(layout, HasSubstr("at 3000 rpm"));
  EXPECT_THAT(layout, HasSubstr("A/B"));
  EXPECT_EQ(layout.find("B/C"), std::string::npos);  // 1.1 x 3.5 is below 4
  EXPECT_NEAR(f.layout["yaxis"]["range"][1].get<double>(), 1.1 * 3.5, 1e-12);
  const std::string high = SensitivityFigure(WithSensitivity(6)).layout.dump();
  EXPECT_THAT(high, HasSubstr("B/C"));
  EXPECT_THAT(high, HasSubstr("C/D"));
  EXPECT_EQ(f.layout["xaxis"]["type"], "log");
  EXPECT_NE(f.layout["yaxis"].value("type", ""), "log");
}

// Measured points belong to the rig at rest and to the axis that was excited.
TEST(SensitivityFigure, MeasuredPointsStandAtRestOnly) {
  RigAnalysis a = WithSensitivity(2);
  a.measured = {{0, 50, {0.3, 0.4}, {}}, {1, 60, {9, 9}, {}}};
  const Figure f = SensitivityFigure(a);
  const Json& points = TraceOf(f, "A.x measured", "y");
  EXPECT_EQ(points["x"], Json({50}));
  EXPECT_EQ(points["y"], Json({0.5}));
  std::size_t count = 0;
  for (const Json& t : f.traces)
    count += t.value("name", "").find("measured") != std::string::npos ? 1 : 0;
  EXPECT_EQ(count, 1u);
}

// L = 1/S - 1: S = 1/2 is L = 1; S = i is L = -1 - i; S = 0.1 (L = 9) lies outside of the figure.
TEST(NyquistFigure, ReturnRatioOfTheSensitivity) {
  RigAnalysis a = WithSensitivity(3);
  a.sensitivity.back().axes[0].S = {{0.1, 0}, {0.5, 0}, {0, 1}};
  const Figure f = NyquistFigure(a);
  const Json& curve = TraceOf(f, "A.x");
  EXPECT_EQ(curve["x"], Json({1, -1}));
  EXPECT_EQ(curve["y"], Json({0, -1}));
  // |S| = 3, 4, 5 are circles of radius 1/3, 1/4, 1/5 round -1.
  ASSERT_EQ(f.layout["shapes"].size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const Json& s = f.layout["shapes"][k];
    const double x0 = s["x0"].get<double>(), x1 = s["x1"].get<double>();
    EXPECT_NEAR((x0 + x1) / 2, -1, 1e-12);
    EXPECT_NEAR((x1 - x0) / 2, 1.0 / (3 + static_cast<double>(k)), 1e-12);
  }
}

ClosedLoopMode Pole(double re, double hertz, double share) {
  ClosedLoopMode m;
  m.s = {re, 2 * kPi * hertz};
  m.frequency = hertz;
  m.rotor_share = share;
  return m;
}

TEST(RootLocusFigure, RotorAndOthersApartAndTheFarLeftIsLeftOut) {
  RigAnalysis a;
  ClosedLoopModes rest, fast;
  rest.speed = 0;
  rest.modes = {Pole(-10, 20, 0.9), Pole(-30, 25, 0.1), Pole(-5000, 10, 0.1)};
  fast.speed = 300;
  fast.modes = {Pole(-12, 22, 0.9)};
  a.rows = {rest, fast};
  const Figure f = RootLocusFigure(a);
  EXPECT_EQ(TraceOf(f, "rotor, at rest")["x"], Json({-10}));
  EXPECT_EQ(TraceOf(f, "rotor, at rest")["y"], Json({20}));
  EXPECT_EQ(TraceOf(f, "rotor")["x"], Json({-12}));
  EXPECT_EQ(TraceOf(f, "others, at rest")["x"], Json({-30}));  // not the pole at -5000
}

// K = k + i w c: 2 N/um and 30 N s/m come back as they were put in.
TEST(StiffnessFigure, StiffnessDampingAndTheLevitatedRotor) {
  RigAnalysis a;
  a.stiffness.frequency = {10, 40};
  AxisStiffness s;
  s.axis = "B.y";
  for (const double f : a.stiffness.frequency) s.bearing.emplace_back(2e6, 2 * kPi * f * 30);
  s.rotor = {{3e6, 4e6}, {0, -1e6}};
  a.stiffness.axes = {s};
  const Figure f = StiffnessFigure(a);
  EXPECT_EQ(TraceOf(f, "B.y", "y")["y"], Json({2, 2}));
  for (const Json& c : TraceOf(f, "B.y", "y2")["y"]) EXPECT_NEAR(c.get<double>(), 30, 1e-9);
  EXPECT_EQ(TraceOf(f, "B.y", "y3")["y"], Json({5, 1}));
  EXPECT_EQ(f.layout["yaxis3"]["type"], "log");
}

// The phase of a double integrator with dead time falls on and on; it is drawn without jumps of a
// turn.
TEST(BodeFigure, PhaseHasNoJumps) {
  ResponseCurve c;
  c.input = "A.x.force";
  c.output = "A.x";
  c.unit = "m/N";
  for (int k = 1; k <= 60; ++k) {
    const double f = 10.0 * k, w = 2 * kPi * f;
    c.frequency.push_back(f);
    c.values.push_back(-1 / (w * w) * std::polar(1.0, -w * 2e-3));
  }
  const Figure figure = BodeFigure(c);
  EXPECT_THAT(figure.caption, HasSubstr("from A.x.force to A.x"));
  EXPECT_THAT(figure.layout.dump(), HasSubstr("[m/N]"));
  const Json& phase = TraceOf(figure, "A.x", "y2")["y"];
  ASSERT_EQ(phase.size(), 60u);
  for (std::size_t k = 0; k < 60; ++k) {
    // -1 is 180 degrees, at the first frequency already turned by less than a half turn.
    const double exact = 180 - 360 * c.frequency[k] * 2e-3;
    EXPECT_NEAR(phase[k].get<double>(), exact, 1e-3) << c.frequency[k];
  }
  const Json& size = TraceOf(figure, "A.x", "y")["y"];
  EXPECT_NEAR(size[0].get<double>() * std::pow(20 * kPi, 2), 1, 5e-5);  // five digits in the page
}

}  // namespace
}  // namespace ambrig
