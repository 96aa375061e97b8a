// The page, the figures and the JSON of a shaft's analysis, on a rotor whose numbers are known by
// hand.
#include "app/pages/shaft_report.h"

#include <gmock/gmock.h>

#include <cmath>

#include "app/figures/shaft_figures.h"
#include "app/json/shaft_json.h"
#include "tests/analysis/shaft/jeffcott_shaft.h"
#include "tests/app/html_page.h"

namespace ambrig {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// All parts: a chosen unbalance, cross-coupling at the disk, a scatter over one spring.
const ShaftAnalysis& WholeAnalysis() {
  static const ShaftAnalysis analysis = [] {
    BeamFile file = testing::JeffcottShaft(1e6, 400);
    ShaftParameter p{"rotor.support[0].k", "N/m", 5e5, 0, 1e12, {}};
    p.set.push_back([](BeamFile& to, double v) { to.definition.supports[0].kxx = v; });
    file.parameters = {p};
    ShaftOptions o = testing::JeffcottOptions();
    o.unbalance = {{{"disk"}, 2e-5, kPi / 2}};
    o.coupled = {"disk"};
    o.coupling = 1e4;
    o.rotors = 20;
    return AnalyseShaft("jeffcott", file, {{p.path, 2.5e4, kRequired}}, o);
  }();
  return analysis;
}

std::string PageOf(const ShaftAnalysis& a) {
  return testing::Written(
      [&](const std::string& path) { WriteShaftReport(a, "shaft.toml", path); });
}

const Json& LineNamed(const Figure& f, const std::string& name, const std::string& axis = "y") {
  static const Json none;
  for (const Json& t : f.traces)
    if (t.value("name", "") == name && t.value("yaxis", "y") == axis) return t;
  ADD_FAILURE() << "no line " << name;
  return none;
}

TEST(ShaftPage, HasEveryPartAndItsNumbers) {
  const std::string words = testing::Words(PageOf(WholeAnalysis()));
  for (const char* part :
       {"Analysis of jeffcott", "shaft shaft.toml, operating 1910 to 3820 rpm",
        "Stable up to 4775 rpm.", "Damped modes", "Critical speeds", "Unbalance",
        "Under its weight", "Cross-coupled stiffness", "Scatter", "10.1508 kg", "z = 0.6 m",
        "either", "Quantiles over 20 rotors, drawn from 1 number with an sd",
        "rotors that have it"})
    EXPECT_THAT(words, HasSubstr(part));
  // Each support holds half of 10.1508 kg x 9.80665 m/s2.
  EXPECT_THAT(words, HasSubstr("\nleft\n0\n49.8"));
}

TEST(ShaftPage, WhatGrowsIsAFailureAndWhatIsMissingIsLeftOut) {
  const std::string stable = PageOf(WholeAnalysis());
  EXPECT_THAT(stable, Not(HasSubstr("class=\"verdict fail\"")));
  ShaftAnalysis a = WholeAnalysis();
  a.campbell.least_decay = -0.5;
  a.level1.reset();
  a.scatter.reset();
  a.unbalance.clear();
  a.weight.held = false;
  a.notes = {"the supports leave a motion free"};
  const std::string html = PageOf(a), words = testing::Words(html);
  EXPECT_THAT(html, HasSubstr("class=\"verdict fail\""));
  EXPECT_THAT(words, HasSubstr("A motion does not decay"));
  EXPECT_THAT(words, HasSubstr("the supports leave a motion free"));
  for (const char* part : {"Unbalance", "Under its weight", "Cross-coupled stiffness", "Scatter"})
    EXPECT_THAT(words, Not(HasSubstr(std::string("\n") + part + "\n")));
}

// Level 1 asks for Q_0 of at least 2 Q_A: c sqrt(k/m) = 1.26e5 N/m is 12.6 times 1e4.
TEST(ShaftPage, Level1IsJudgedByRatioAndDecrement) {
  EXPECT_THAT(testing::Words(PageOf(WholeAnalysis())), HasSubstr("Q_0/Q_A = 12.6"));
  ShaftAnalysis a = WholeAnalysis();
  const std::size_t good = testing::CountOf(PageOf(a), "class=\"verdict warn\"");
  a.level1->limit = 1.5e4;
  EXPECT_EQ(testing::CountOf(PageOf(a), "class=\"verdict warn\""), good + 1);
}

TEST(ShaftFigures, TheOutlineIsDrawnAtBothSidesInMillimetres) {
  const Figure f = ShaftFigure(WholeAnalysis());
  double lowest = 0, highest = 0;
  for (const Json& t : f.traces)
    if (t.value("name", "") == "outline")
      for (const Json& y : t["y"]) {
        lowest = std::min(lowest, y.get<double>());
        highest = std::max(highest, y.get<double>());
      }
  EXPECT_NEAR(highest, 200, 1e-9);  // diameter 0.4 m
  EXPECT_NEAR(lowest, -200, 1e-9);
  // The heaviest disk is three times as high as the shaft; supports are points at its ends.
  EXPECT_EQ(LineNamed(f, "disk")["y"], Json({-600, 600}));
  EXPECT_EQ(LineNamed(f, "supports")["x"], Json({0, 1.2}));
}

// The page shows x along (-0.55 0.82, -0.55 0.57) and y upwards; a shaft is 3.2 largest deflections
// long.
TEST(ShaftFigures, ShapesTurnAndTheirLargestDeflectionIsOne) {
  const ShaftAnalysis& a = WholeAnalysis();
  const Figure f = ShaftModesFigure(a);
  EXPECT_THAT(f.caption, HasSubstr("at 3820 rpm"));
  ASSERT_GE(f.panels, 2);
  const Json& frames = f.layout["meta"]["frames"];
  ASSERT_EQ(frames.size(), 24u);
  const std::size_t shapes =
      frames[0]["traces"].size();  // of the modes that the row has, six at most
  ASSERT_GE(shapes, 2u);
  const auto [lo, hi] = std::minmax_element(a.beam.z.begin(), a.beam.z.end());
  double largest = 0;
  for (const Json& frame : frames) {
    ASSERT_EQ(frame["data"].size(), shapes);
    const Json &px = frame["data"][0]["x"], &py = frame["data"][0]["y"];
    const std::size_t pieces = (px.size() - 1) / (a.beam.z.size() - 1);
    ASSERT_EQ(px.size(), pieces * (a.beam.z.size() - 1) + 1);
    ASSERT_GE(px.size(), 40u);  // a line without corners
    for (std::size_t i = 0; i < px.size(); ++i) {
      const std::size_t node = i / pieces, next = std::min(node + 1, a.beam.z.size() - 1);
      const double share = double(i % pieces) / double(pieces),
                   z = a.beam.z[node] + share * (a.beam.z[next] - a.beam.z[node]),
                   along = 3.2 * (z - *lo) / (*hi - *lo),
                   x = (along - px[i].get<double>()) / (0.55 * 0.82),
                   y = py[i].get<double>() + 0.55 * 0.57 * x;
      largest = std::max({largest, std::abs(x), std::abs(y)});
    }
  }
  EXPECT_NEAR(largest, 1, 2e-3);  // four digits of places up to 3.2
  // The first frame is what stands there before anything turns.
  const Json& still = f.traces[frames[0]["traces"][0].get<std::size_t>()];
  EXPECT_EQ(still["name"], "centre");
  EXPECT_EQ(still["y"], frames[0]["data"][0]["y"]);
}

// Between its nodes the line is the element's own shape: a light shaft with a disk in its middle
// bends as under a load there, by 3 t - 4 t³ at t = z/L from the support; left over is the shaft's
// own mass, 1 g of 10 kg, and the page's digits.
TEST(ShaftFigures, ShapesBendBetweenTheNodes) {
  BeamFile file = testing::JeffcottShaft(1e9, 400);
  ShaftSection& shaft = file.definition.sections[0];
  shaft.od = shaft.od_right = 0.03;
  shaft.material.E = 2e11;
  const Figure f = ShaftModesFigure(AnalyseShaft("light", file, {}, testing::JeffcottOptions()));
  const Json& frame = f.layout["meta"]["frames"][0]["data"][0];
  const std::size_t points = frame["x"].size(), middle = points / 2;
  std::vector<double> x, y;
  for (std::size_t i = 0; i < points; ++i) {
    const double along = 3.2 * double(i) / double(points - 1);
    x.push_back((along - frame["x"][i].get<double>()) / (0.55 * 0.82));
    y.push_back(frame["y"][i].get<double>() + 0.55 * 0.57 * x.back());
  }
  const std::vector<double>& bent = std::abs(x[middle]) > std::abs(y[middle]) ? x : y;
  EXPECT_NEAR(std::abs(bent[middle]), 1, 2e-3);
  for (std::size_t i = 1; i < middle; ++i) {
    const double t = 0.5 * double(i) / double(middle);
    EXPECT_NEAR((bent[i] - bent[0]) / (bent[middle] - bent[0]), 3 * t - 4 * t * t * t, 2e-3) << i;
  }
}

TEST(ShaftFigures, BandsOfTheScatterHoldTheirMiddle) {
  const Figure f = ScatterFigure(WholeAnalysis(), "chosen");
  EXPECT_THAT(f.caption, HasSubstr("over 20 rotors"));
  ASSERT_EQ(f.panels, 3);  // left, disk, right
  std::vector<const Json*> edges;
  int shown = 0;
  for (const Json& t : f.traces)
    if (t["name"] == "5 to 95 %") {
      if (t.value("yaxis", "y") == "y2") edges.push_back(&t);
      shown += t.value("showlegend", true) ? 1 : 0;
    }
  EXPECT_EQ(shown, 1);
  ASSERT_EQ(edges.size(), 2U);
  const Json& middle = LineNamed(f, "50 %", "y2")["y"];
  ASSERT_EQ((*edges[0])["y"].size(), middle.size());
  for (std::size_t k = 0; k < middle.size(); ++k) {
    EXPECT_LE((*edges[0])["y"][k].get<double>(), middle[k].get<double>());
    EXPECT_GE((*edges[1])["y"][k].get<double>(), middle[k].get<double>());
  }
}

TEST(ShaftFigures, SagShearAndMomentOfAShaftOnTwoSupports) {
  const ShaftAnalysis& a = WholeAnalysis();
  const Figure f = WeightFigure(a);
  const double w = a.weight.weight;
  // Two springs of 5e5 N/m sink by w/1e6 each; the shear starts at half the weight.
  EXPECT_NEAR(LineNamed(f, "y")["y"][0].get<double>(), -w / 1e6 * 1e6, 1e-3 * w);
  EXPECT_NEAR(LineNamed(f, "shear", "y2")["y"][0].get<double>() / (w / 2), 1, 1e-4);
  EXPECT_NEAR(LineNamed(f, "moment", "y3")["y"][0].get<double>(), 0, 1e-6 * w);
}

// Above its critical speed the shaft moves against the unbalance: the phase falls by half a turn.
TEST(ShaftFigures, PhaseFallsByHalfATurnThroughTheCriticalSpeed) {
  const ShaftAnalysis& a = WholeAnalysis();
  const Figure f = ShaftResponseFigure(a, a.unbalance[0]);
  EXPECT_THAT(f.caption, HasSubstr("20 g mm at z = 0.6 m, 90°"));
  const Json& phase = LineNamed(f, "disk", "y2")["y"];
  EXPECT_NEAR(phase.front().get<double>(), 90, 2);
  const double zeta = 400 / (2 * std::sqrt(1e6 * a.totals.mass)),
               w = std::sqrt(1e6 / a.totals.mass),
               r = 500 / w;  // at the highest speed
  const double behind = std::atan2(2 * zeta * r, 1 - r * r) * 180 / kPi;
  EXPECT_NEAR(phase.back().get<double>(), 90 - behind, 0.1);
  const Json& force = LineNamed(f, "force left", "y3")["y"];
  EXPECT_EQ(force.size(), a.unbalance[0].speed.size());
  EXPECT_THAT(f.layout.dump(), HasSubstr("operating"));
}

TEST(ShaftFigures, OrbitIsACircleOfThePeak) {
  const ShaftAnalysis& a = WholeAnalysis();
  const Figure f = ShaftOrbitFigure(a, a.unbalance[0]);
  const Json& orbit = LineNamed(f, "disk");
  const double peak = a.unbalance[0].probes[1].peaks.at(0).amplitude * 1e6;
  for (std::size_t k = 0; k < orbit["x"].size(); ++k)
    EXPECT_NEAR(std::hypot(orbit["x"][k].get<double>(), orbit["y"][k].get<double>()) / peak, 1,
                0.01);
}

TEST(ShaftFigures, RodsAndCouplingCarryTheirNumbers) {
  const ShaftAnalysis& a = WholeAnalysis();
  const Figure rods = RodFigure(a);
  EXPECT_EQ(rods.panels, 2);
  EXPECT_FALSE(rods.traces.empty());
  const Figure coupling = CouplingFigure(*a.level1);
  EXPECT_EQ(LineNamed(coupling, "log decrement")["y"].size(), a.level1->q.size());
  EXPECT_EQ(coupling.layout["shapes"][0]["y0"], 0.1);
}

TEST(ShaftJson, NumbersAsTheyAreAndNothingThatWasNotAsked) {
  const ShaftAnalysis& a = WholeAnalysis();
  const auto json = ShaftJson(a);
  EXPECT_EQ(json["mass"], a.totals.mass);
  EXPECT_EQ(json["stable"], true);
  EXPECT_EQ(json["speed"]["fastest"], 500);
  EXPECT_EQ(json["campbell"].size(), a.campbell.rows.size());
  const auto& mode = json["campbell"][0]["modes"][0];
  EXPECT_NEAR(mode["im"].get<double>() / (2 * kPi), mode["frequency"].get<double>(), 1e-9);
  EXPECT_EQ(json["level_1"]["passed"], a.level1->passed());
  EXPECT_EQ(json["scatter"]["rotors"], 20);
  EXPECT_EQ(json["scatter"]["parameters"][0], "rotor.support[0].k");
  const auto& probe = json["unbalance"][0]["probes"][1];
  EXPECT_EQ(probe["name"], "disk");
  EXPECT_EQ(probe["major"].size(), json["unbalance"][0]["speed"].size());
  EXPECT_EQ(probe["x"][3], std::abs(a.unbalance[0].probes[1].x[3]));
  EXPECT_EQ(json["weight"]["reactions"][1]["support"], "right");
  ShaftAnalysis less = a;
  less.level1.reset();
  less.scatter.reset();
  EXPECT_FALSE(ShaftJson(less).contains("level_1"));
  EXPECT_FALSE(ShaftJson(less).contains("scatter"));
}

// JSON has no infinity: a limit that was not reached is null.
TEST(ShaftJson, ALimitThatWasNotReachedIsNull) {
  ShaftAnalysis a = WholeAnalysis();
  a.level1->limit = kInfinity;
  EXPECT_TRUE(ShaftJson(a)["level_1"]["limit"].is_null());
}

}  // namespace
}  // namespace ambrig
