// Figures that follow from a rig's numbers, against statics and magnetics.
#include "rig/rig_figures.h"

#include <gmock/gmock.h>

#include <cmath>

#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"
#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

RigParameters ExampleRig(const std::string& folder) {
  return ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/" + folder + "/rig.toml");
}

double Sum(const RigParameters& rig, int side, int power) {
  double sum = 0;
  const auto shares = WeightShares(rig);
  for (std::size_t k = 0; k < shares.size(); ++k)
    if (rig.bearings[k].kind->two_axes)
      sum += shares[k][static_cast<std::size_t>(side)] * std::pow(rig.bearings[k].z, power);
  return sum;
}

// Forces and moments about the centre of mass balance the weight, whatever the number of bearings.
TEST(WeightShares, BalanceForceAndMoment) {
  RigParameters rig = ReferenceLanesRig();
  rig.gravity = {3, -9.81, 0.5};
  BearingParameters third = rig.bearings[0];
  third.name = "C";
  third.z = 0.05;
  for (int bearings = 2; bearings <= 3; ++bearings) {
    EXPECT_NEAR(Sum(rig, 0, 0), -rig.rotor.mass * 3, 1e-9);
    EXPECT_NEAR(Sum(rig, 1, 0), rig.rotor.mass * 9.81, 1e-9);
    EXPECT_NEAR(Sum(rig, 0, 1), 0, 1e-9);
    EXPECT_NEAR(Sum(rig, 1, 1), 0, 1e-9);
    rig.bearings.insert(rig.bearings.begin() + 2, third);
  }
  EXPECT_NEAR(WeightShares(rig).back()[0], -rig.rotor.mass * 0.5, 1e-12);  // the thrust bearing
}

// Two bearings are a lever.
TEST(WeightShares, OfTwoBearingsAreALever) {
  const RigParameters rig = ReferenceLanesRig();
  const double a = rig.bearings[0].z, b = rig.bearings[1].z, w = rig.rotor.mass * 9.81;
  const auto shares = WeightShares(rig);
  EXPECT_NEAR(shares[0][1], w * b / (b - a), 1e-9);
  EXPECT_NEAR(shares[1][1], -w * a / (b - a), 1e-9);
  EXPECT_THAT(WeightOverAxes(rig),
              ElementsAre(shares[0][0], shares[0][1], shares[1][0], shares[1][1], shares[2][0]));
}

// A single radial bearing carries all, wherever it is.
TEST(WeightShares, OfOneBearingIsTheWeight) {
  RigParameters rig = ReferenceLanesRig();
  rig.bearings.erase(rig.bearings.begin() + 1);
  EXPECT_NEAR(WeightShares(rig)[0][1], rig.rotor.mass * 9.81, 1e-9);
}

// k c0 is the slope of the force at the centre over the control current v, i = W (c0, v, 0).
TEST(ForceConstant, IsTheSlopeOfARadialBearingsForce) {
  const RigParameters& rig = ReferenceLanesRig();
  const BearingParameters& b = *rig.Find("A");
  const RadialStator stator(b.radial);
  const double c0 = BiasCurrent(rig, b), h = 1e-4;
  const auto directions = CoilDirections(b);
  const auto force = [&](double v) {
    CoilVector i;
    for (int j = 0; j < kPoles; ++j) i[j] = c0 + v * directions[static_cast<std::size_t>(j)][0];
    return stator.Force({0, 0}, i).x();
  };
  const double k = ForceConstant(b);
  EXPECT_NEAR((force(h) - force(-h)) / (2 * h), k * c0, 1e-6 * k * c0);
}

// Flux of a side N (i1 + i2) mu0 A/(2 g), Maxwell stress over both rings.
TEST(ForceConstant, OfAThrustBearingFollowsFromItsFlux) {
  const BearingParameters& b = *ReferenceLanesRig().Find("Z");
  const ThrustStatorParameters& p = b.thrust;
  const auto side = [&](double i) {
    const double phi = p.turns * 2 * i * kMu0 * p.pole_area / (2 * p.gap);
    return phi * phi / (kMu0 * p.pole_area);
  };
  const double c0 = p.bias_current, v = 0.1;
  EXPECT_NEAR(side(c0 + v) - side(c0 - v), ForceConstant(b) * c0 * v, 1e-9);
}

// dL/dg of an opposed magnet by differences; one coil alone has half.
TEST(ForceConstant, OfAnOpposedBearingIsTheSlopeOfItsInductance) {
  const RigParameters rig = ExampleRig("mls2em");
  BearingParameters b = rig.bearings[0];
  const OpposedStatorParameters& p = b.opposed;
  const auto L = [&](double g) {
    return p.inductance_far + p.inductance_near / (1 + g / p.gap_constant);
  };
  const double h = 1e-4 * p.gap, slope = -(L(p.gap + h) - L(p.gap - h)) / (2 * h);
  b.opposed.coils = 2;
  EXPECT_NEAR(ForceConstant(b), 2 * slope, 1e-6 * slope);
  b.opposed.coils = 1;
  EXPECT_NEAR(ForceConstant(b), slope, 1e-6 * slope);
}

// The stop where there is one; else half of the way to the poles.
TEST(Clearance, IsThatOfTheAuxiliaryBearing) {
  BearingParameters a = *ReferenceLanesRig().Find("A"), z = *ReferenceLanesRig().Find("Z");
  EXPECT_EQ(ClearanceOf(a), 2e-4);
  EXPECT_EQ(ClearanceOf(z), 2.5e-4);
  a.radial.gap = z.thrust.gap = 8e-4;
  EXPECT_EQ(ClearanceOf(a), 2e-4);
  a.auxiliary.reset();
  z.auxiliary.reset();
  EXPECT_EQ(ClearanceOf(a), 4e-4);
  EXPECT_EQ(ClearanceOf(z), 4e-4);
  const RigParameters magnet = ExampleRig("mls2em");
  EXPECT_EQ(GapOf(magnet.bearings[0]), magnet.bearings[0].opposed.gap);
}

// One magnet alone stands on the side that it pulls to; every other bearing has poles on both.
TEST(Clearance, PolesStandWhereMagnetsAre) {
  BearingParameters m = ExampleRig("mls2em").bearings[0];
  const double gap = m.opposed.gap;
  EXPECT_TRUE(InPole(m, gap, 0));
  EXPECT_FALSE(InPole(m, -3 * gap, 0));
  EXPECT_TRUE(InPole(m, 0.5 * gap, 0.6 * gap, 0));  // where its pole stands nearer than drawn
  EXPECT_FALSE(InPole(m, 0.5 * gap, -0.6 * gap, 0));
  m.opposed.coils = 2;
  EXPECT_TRUE(InPole(m, -gap, 0));
  const BearingParameters& a = *ReferenceLanesRig().Find("A");
  EXPECT_TRUE(InPole(a, 3e-4, -3e-4));
  EXPECT_FALSE(InPole(a, 2.8e-4, -2.8e-4));
}

TEST(BearingKinds, AreFoundByTheNamesThatFilesGiveThem) {
  EXPECT_EQ(BearingKindNames(), "radial, thrust, opposed, stator, axial-stator");
  for (const BearingKind* k : BearingKinds()) EXPECT_EQ(FindBearingKind(k->name), k);
  EXPECT_EQ(FindBearingKind("axial"), nullptr);
  EXPECT_EQ(BearingParameters{}.kind, FindBearingKind("radial"));
}

// The coils of a bearing pull in all directions alike: their sum is zero, Σ d d' is a multiple of
// 1.
TEST(CoilDirections, AreBalanced) {
  for (const BearingParameters& b : ReferenceLanesRig().bearings) {
    double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (const auto& [dx, dy] : CoilDirections(b)) {
      EXPECT_NEAR(std::hypot(dx, dy), 1, 1e-12);
      x += dx, y += dy, xx += dx * dx, yy += dy * dy, xy += dx * dy;
    }
    EXPECT_NEAR(x, 0, 1e-12);
    EXPECT_NEAR(y, 0, 1e-12);
    if (b.kind->two_axes) {
      EXPECT_NEAR(xx, yy, 1e-12);
      EXPECT_NEAR(xy, 0, 1e-12);
    }
  }
}

TEST(RigFigures, BiasCoilsAndControllersOfEachBearing) {
  RigParameters rig = ReferenceLanesRig();
  EXPECT_THAT(CoilsOf(rig), ElementsAre(8, 8, 4));
  EXPECT_EQ(BiasCurrent(rig, rig.bearings[0]), rig.controller.bias_current);
  EXPECT_EQ(BiasCurrent(rig, rig.bearings[2]), 1.5);
  EXPECT_EQ(&PidOf(rig, rig.bearings[0]), &rig.controller.pid);
  EXPECT_EQ(PidOf(rig, rig.bearings[2]).kp, 3e5);
  EXPECT_EQ(CoilResistance(rig.bearings[2]), 0.6);
  EXPECT_THAT(AxisNames(rig), ElementsAre("A.x", "A.y", "B.x", "B.y", "z"));
  EXPECT_THAT(ControlledAxes(rig), ElementsAre(0u, 1u, 2u, 3u));  // Z has its own controller
}

TEST(RigFigures, EffectsFindTheirTargets) {
  const EffectTargets t = TargetsOfEffects(ReferenceLanesRig());
  EXPECT_THAT(t.bearings, ElementsAre("A", "B", "Z"));
  EXPECT_THAT(t.planes, ElementsAre("A", "B", "z"));
  EXPECT_THAT(t.axes, ElementsAre("A.x", "A.y", "B.x", "B.y", "z"));
  EXPECT_EQ(t.coils.size(), 20u);
  EXPECT_THAT(t.coils, Contains("Z.coil4"));
  EXPECT_EQ(t.kind.at("A.coil3"), kOnRadial);
  EXPECT_EQ(t.kind.at("z"), kOnThrust);
}

// Rates that the engine can give: the switching frequency over an integer, or a divisor of the
// samples of a period times it.
TEST(RecordRateFor, IsTheNextRateThatTheEngineHas) {
  const RigParameters& rig = ReferenceLanesRig();  // 25 kHz, 18 samples
  EXPECT_DOUBLE_EQ(RecordRateFor(rig, 25e3), 25e3);
  EXPECT_DOUBLE_EQ(RecordRateFor(rig, 12.5e3), 12.5e3);
  EXPECT_DOUBLE_EQ(RecordRateFor(rig, 9000), 12.5e3);  // 25 kHz over 2, not over 3
  EXPECT_DOUBLE_EQ(RecordRateFor(rig, 30e3), 50e3);
  EXPECT_DOUBLE_EQ(RecordRateFor(rig, 60e3), 75e3);
  EXPECT_DOUBLE_EQ(RecordRateFor(rig, 100e3), 150e3);  // 4 and 5 do not divide 18
  EXPECT_DOUBLE_EQ(RecordRateFor(rig, 1e9), 450e3);
}

}  // namespace
}  // namespace ambrig
