// All of a shaft at once, on a rotor whose numbers are known by hand, and how its planes are named.
#include "analysis/shaft/shaft_analysis.h"

#include <gmock/gmock.h>

#include "analysis/shaft/shaft_planes.h"
#include "tests/analysis/shaft/jeffcott_shaft.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using testing::JeffcottOptions;
using testing::JeffcottShaft;
using testing::kJeffcottLength;

constexpr double kSpring = 1e6, kDamper = 400;  // [N/m], [N s/m]

ShaftAnalysis Analysed(const ShaftOptions& options) {
  return AnalyseShaft("jeffcott", JeffcottShaft(kSpring, kDamper), {}, options);
}

/// The message of the mistake that `run` makes.
template <class F>
std::string MistakeOf(F&& run) {
  try {
    run();
  } catch (const InputError& e) {
    return e.what();
  }
  return "nothing was refused";
}

// Bounce at sqrt(k/m): 10.15 kg on 1e6 N/m; API 617's unbalance at each support; weight m g.
TEST(ShaftAnalysis, JeffcottRotorByHand) {
  const ShaftAnalysis a = Analysed(JeffcottOptions());
  const double m = a.totals.mass, w = std::sqrt(kSpring / m);
  EXPECT_NEAR(m, 10 + kPi / 4 * 0.16 * kJeffcottLength, 1e-9);
  EXPECT_TRUE(a.campbell.stable());
  EXPECT_TRUE(a.notes.empty());
  double nearest = 0;
  for (const CriticalSpeed& c : a.undamped)
    if (std::abs(c.speed - w) < std::abs(nearest - w)) nearest = c.speed;
  EXPECT_NEAR(nearest / w, 1, 1e-4);
  EXPECT_NEAR(a.weight.weight, m * kStandardGravity, 1e-6 * m);
  ASSERT_EQ(a.unbalance.size(), 3u);  // static, couple, middle of API 617
  EXPECT_NEAR(a.unbalance[0].unbalance.planes[0].magnitude,
              6350e-6 * m / 2 / (JeffcottOptions().highest / kRpm), 1e-6 * 6350e-6 * m);
  ASSERT_EQ(a.unbalance[0].probes.size(), 3u);  // left, disk, right, from left to right
  EXPECT_EQ(a.unbalance[0].probes[0].probe.name, "left");
  EXPECT_EQ(a.unbalance[0].probes[1].probe.name, "disk");
  EXPECT_FALSE(a.level1.has_value());
  EXPECT_FALSE(a.scatter.has_value());
}

// Between the even speeds of a sweep stand finer ones, so that a peak is met: AF = 1/(2 zeta).
TEST(ShaftAnalysis, SweepIsFineAtACriticalSpeed) {
  ShaftOptions o = JeffcottOptions();
  o.unbalance = {{{"disk"}, 1e-5, 0}};
  o.probes = {{"0.6"}};
  const ShaftAnalysis a = AnalyseShaft("j", JeffcottShaft(kSpring, 15), {}, o);
  ASSERT_EQ(a.unbalance.size(), 1u);
  ASSERT_EQ(a.unbalance[0].probes.size(), 1u);
  EXPECT_EQ(a.unbalance[0].probes[0].probe.name, "z = 0.6");
  const auto& peaks = a.unbalance[0].probes[0].peaks;
  ASSERT_EQ(peaks.size(), 1u);
  const double w = std::sqrt(kSpring / a.totals.mass), zeta = 15 / (2 * a.totals.mass * w);
  EXPECT_NEAR(peaks[0].amplification * 2 * zeta, 1, 0.02);  // Q = 106: 1.5 rad/s wide at half power
  EXPECT_NEAR(peaks[0].amplitude / (1e-5 / a.totals.mass / (2 * zeta)), 1, 1e-3);
}

// Every support at one stiffness k: the bounce is at sqrt(2 k/m) as long as the bar does not bend.
TEST(ShaftAnalysis, MapFollowsTheSquareRootOfTheStiffness) {
  const BeamRotor beam = BuildBeam(JeffcottShaft(kSpring, 0).definition);
  const double m = Totals(beam).mass;
  const auto rows = MapCriticalSpeeds(beam, {1e4, 1e5, 1e6}, 4);
  ASSERT_EQ(rows.size(), 3u);
  for (const CriticalMapRow& row : rows) {
    const double exact = std::sqrt(2 * row.stiffness / m);
    double nearest = 0;
    for (const CriticalSpeed& c : row.speeds)
      if (std::abs(c.speed - exact) < std::abs(nearest - exact)) nearest = c.speed;
    EXPECT_NEAR(nearest / exact, 1, 1e-4) << row.stiffness;
  }
}

TEST(ShaftAnalysis, ChosenUnbalanceGradeAndCoupling) {
  ShaftOptions o = JeffcottOptions();
  o.grade = 2.5e-3;
  o.coupled = {"disk"};
  o.coupling = 1e4;
  const ShaftAnalysis a = Analysed(o);
  ASSERT_EQ(a.unbalance.size(), 2u);  // static and couple of ISO 21940-11
  double sum = 0;
  for (const PlaneUnbalance& p : a.unbalance[0].unbalance.planes) sum += p.magnitude;
  EXPECT_NEAR(sum / (a.totals.mass * o.grade / o.highest), 1, 1e-9);
  ASSERT_TRUE(a.level1.has_value());
  EXPECT_EQ(a.level1->given.z, kJeffcottLength / 2);
  // The limit of a Jeffcott rotor is q = c sqrt(k/m).
  EXPECT_NEAR(a.level1->limit / (kDamper * std::sqrt(kSpring / a.totals.mass)), 1, 1e-3);
}

TEST(ShaftAnalysis, AFreeShaftIsSaidToBeFree) {
  BeamFile file = JeffcottShaft(kSpring, kDamper);
  file.definition.supports.clear();
  const ShaftAnalysis a = AnalyseShaft("free", file, {}, JeffcottOptions());
  ASSERT_EQ(a.notes.size(), 1u);
  EXPECT_THAT(a.notes[0], HasSubstr("a free shaft"));
  EXPECT_FALSE(a.weight.held);
  EXPECT_TRUE(a.unbalance.empty());
  EXPECT_TRUE(a.map.empty());
}

// A table of coefficients that ends below the highest speed is used with its last row, and that is
// said.
TEST(ShaftAnalysis, ATableThatEndsTooEarlyIsNoted) {
  BeamFile file = JeffcottShaft(kSpring, kDamper);
  SpringSupport& s = file.definition.supports[1];
  s.speed = {0, 300};
  s.table = {s, s};
  const ShaftAnalysis a = AnalyseShaft("t", file, {}, JeffcottOptions());
  ASSERT_EQ(a.notes.size(), 1u);
  EXPECT_THAT(a.notes[0], HasSubstr("support right: its table goes from 0 to 2865 rpm"));
}

TEST(ShaftAnalysis, StopsWhenItIsTold) {
  const std::atomic<bool> stop{true};
  ShaftOptions o = JeffcottOptions();
  o.stop = &stop;
  EXPECT_THROW(Analysed(o), Interrupted);
}

TEST(ShaftPlanes, ByNameByPlaceAndNotElsewhere) {
  BeamFile file = JeffcottShaft(kSpring, kDamper);
  file.definition.housings.push_back({"casing", 20, 20, 20});
  EXPECT_EQ(FindPlane(file, {"disk"}, "probe").z, kJeffcottLength / 2);
  EXPECT_EQ(FindPlane(file, {"right"}, "probe").z, kJeffcottLength);
  EXPECT_EQ(FindPlane(file, {"casing"}, "probe").housing, "casing");
  EXPECT_EQ(FindPlane(file, {"0.25"}, "probe").z, 0.25);
  for (const char* wrong : {"1.3", "-0.1", "wheel", "0.2x", ""}) {
    const std::string said = MistakeOf([&] { FindPlane(file, {wrong}, "probe"); });
    EXPECT_THAT(said, HasSubstr("--probe: plane " + std::string(wrong)));
    EXPECT_THAT(said, HasSubstr("a z from 0 to 1.2 m or disk, left, right, casing"));
  }
}

TEST(ShaftPlanes, OnePlaceHasOneNameAndAShaftWithoutNamesItsEnds) {
  BeamFile file = JeffcottShaft(kSpring, kDamper);
  file.planes.push_back({"journal", kJeffcottLength});  // where a support stands already
  const auto named = NamedPlanes(file, BuildBeam(file.definition));
  ASSERT_EQ(named.size(), 3u);
  EXPECT_EQ(named[2].name, "right");
  BeamFile bare = file;
  bare.planes.clear();
  bare.definition.supports.clear();
  const auto ends = NamedPlanes(bare, BuildBeam(bare.definition));
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_EQ(ends[0].z, 0);
  EXPECT_EQ(ends[1].z, kJeffcottLength);
}

TEST(ShaftPlanes, UnbalanceAndCouplingNeedTheShaft) {
  BeamFile file = JeffcottShaft(kSpring, kDamper);
  file.definition.housings.push_back({"casing", 20, 20, 20});
  file.definition.supports[0].on = "casing";
  SpringSupport ground = IsotropicSupport(0, 1e8, 0);
  ground.z = kRequired;
  ground.carries = "casing";
  file.definition.supports.push_back(ground);
  ShaftOptions o = JeffcottOptions();
  o.unbalance = {{{"casing"}, 1e-5, 0}};
  EXPECT_THAT(MistakeOf([&] { AnalyseShaft("h", file, {}, o); }),
              HasSubstr("--unbalance: plane casing is a housing"));
  o = JeffcottOptions();
  o.coupled = {"casing"};
  o.coupling = 1e4;
  EXPECT_THAT(MistakeOf([&] { AnalyseShaft("h", file, {}, o); }),
              HasSubstr("--cross-coupling: plane casing is a housing"));
}

}  // namespace
}  // namespace ambrig
