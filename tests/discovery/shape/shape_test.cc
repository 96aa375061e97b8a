#include "discovery/shape/shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "core/base/errors.h"
#include "effects/diffusion_fit.h"
#include "effects/steel_curve.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

EffectInstance Named(const std::string& id, const Values& values, const std::string& at = "A") {
  EffectInstance e = MakeInstance(EffectNamed(id), at);
  for (const auto& [name, value] : values) e.Set(name, value);
  return e;
}

// The start is the law that was named. A path linear between nodes h apart integrates to more than
// a convex one: by h²/12 times the growth of the drop's second derivative (trapezoidal rule; half
// as much again for its next term).
TEST(Shape, StartsAtTheSteelCurve) {
  constexpr double kReach = 0.55, kKnee = 0.5, kPath = 0.08, h = kReach / 12;
  const Shape s = ShapeOf(Named("saturation", {{"knee", kKnee}, {"path", kPath}}), ReferenceRig(),
                          {.density = kReach});
  double H, slope, above, below;
  SteelCurve((kReach + 1e-4) / kKnee, &H, &above);
  SteelCurve((kReach - 1e-4) / kKnee, &H, &below);
  const double bend = kPath * (above - below) / kKnee / 2e-4, most = 1.5 * h * h / 12 * bend;
  SteelCurve(kReach / kKnee, &H, &slope);
  EXPECT_LT(most, 0.1 * kPath * H);
  for (const double B : s.u) {
    SteelCurve(B / kKnee, &H, &slope);
    EXPECT_NEAR(s.value(s.Sizes(), B), kPath * H, most) << B;
  }
}

// Steel needs MMF at low flux beyond its path: threshold x/(1 + x), x = B/0.2 T. Trapezoidal rule
// as above; the drop's second derivative falls from 2 threshold/(0.2 T)² in size.
TEST(Shape, StartsAtTheReluctanceOfSteel) {
  constexpr double kReach = 0.6, kPath = 2e-5, kThreshold = 5, h = kReach / 12;
  const Shape s = ShapeOf(Named("iron-reluctance", {{"path", kPath}, {"threshold", kThreshold}}),
                          ReferenceRig(), {.density = kReach});
  const double most = 1.5 * h * h / 12 * 2 * kThreshold / 0.04;
  for (const double B : s.u)
    EXPECT_NEAR(s.value(s.Sizes(), B), kPath * B / kMu0 + kThreshold * B / (0.2 + B), most) << B;
}

// Ten relaxations against the half order of diffusion and against laminations.
TEST(Shape, StartsAtTheDiffusionLaw) {
  const RigParameters rig = ReferenceRig();
  for (const double path : {0.0, 3e-5}) {
    const Shape s = ShapeOf(Named("eddy-currents", {{"cutoff", 3000}, {"path", path}}), rig, {});
    const double rho = path / rig.Find("A")->radial.gap;
    for (double f = 60; f < 1e5; f *= 1.3) {
      const std::complex<double> wanted = Diffusion({0, 2 * kPi * f}, 3000, rho);
      EXPECT_NEAR(s.value(s.Sizes(), f), std::abs(wanted), 0.05 * std::abs(wanted) + 1e-3) << f;
    }
  }
}

TEST(Shape, HysteresisKeepsItsCoerciveCurrent) {
  const Shape s = ShapeOf(Named("hysteresis", {{"coercive", 0.08}, {"width", 0.2}}), ReferenceRig(),
                          {.density = 0.6});
  EXPECT_NEAR(s.value(s.Sizes(), 0.6), 0.08,
              1e-12);  // all operators slip beyond three times the width
}

// The law's radii are evenly spread up to its width: an operator stands for those next below its
// own radius.
TEST(Shape, HysteresisStartsWithTheOperatorsOfItsWidth) {
  const Shape s = ShapeOf(Named("hysteresis", {{"coercive", 0.08}, {"width", 0.2}}), ReferenceRig(),
                          {.density = 0.32});
  const std::vector<double> sizes = s.Sizes();  // radii 0.32 T k²/64: the sixth is 0.18 T
  for (int k = 1; k <= 6; ++k)
    EXPECT_NEAR(sizes[static_cast<std::size_t>(k) - 1], 0.08 * (2 * k - 1) * 0.005 / 0.2, 1e-12)
        << k;
  EXPECT_NEAR(sizes[6], 0.08 * (0.2 - 0.18) / 0.2, 1e-12);
  EXPECT_EQ(sizes[7], 0);
  EXPECT_EQ(s.value_unit, "A");
  EXPECT_EQ(s.u_unit, "T");
}

TEST(Shape, SaysWhatItsCurveIsOf) {
  const Shape eddy = ShapeOf(Named("eddy-currents", {{"cutoff", 3000}}), ReferenceRig(), {});
  EXPECT_EQ(eddy.u_name, "frequency");
  EXPECT_EQ(eddy.u_unit, "Hz");
  EXPECT_TRUE(eddy.logarithmic);
  EXPECT_NEAR(eddy.u.front(), 10, 1e-9);
  EXPECT_NEAR(eddy.u.back(), 3e5, 1e-3);
  const Shape iron = ShapeOf(Named("saturation", {{"knee", 0.5}, {"path", 0.08}}), ReferenceRig(),
                             {.density = 0.5});
  EXPECT_NE(iron.u_name, "");
  EXPECT_NE(iron.value_unit, "");
  EXPECT_NEAR(iron.u.back(), 0.5, 1e-12);
}

// A pull that pushes back stays one: slopes may not change their sign in a fit.
TEST(Shape, SlopesKeepTheSignOfTheLawThatWasNamed) {
  for (const double stiffness : {4e4, -4e4}) {
    const Shape s =
        ShapeOf(Named("side-pull", {{"stiffness", stiffness}}), ReferenceRig(), {.radius = 6e-5});
    ASSERT_FALSE(s.rows.empty());
    for (const std::size_t row : s.rows) {
      const EffectParameter& p = s.effect.table[row];
      EXPECT_EQ(p.lo, stiffness > 0 ? 0 : -1e9);
      EXPECT_EQ(p.hi, stiffness > 0 ? 1e9 : 0);
      EXPECT_EQ(s.effect.values[row], stiffness);
    }
  }
}

// The formula in the rig file and the curve in the report are the same law: read back, the formula
// pulls as the curve says.
TEST(Shape, PullFormulaSaysWhatTheCurveSays) {
  Shape s = ShapeOf(Named("side-pull", {{"stiffness", 4e4}, {"ex", 1e-5}, {"ey", -2e-5}}),
                    ReferenceRig(), {.radius = 6e-5});
  for (std::size_t k = 0; k < s.rows.size(); ++k)
    s.effect.values[s.rows[k]] = 1e4 * static_cast<double>(k + 1);
  RigParameters rig = ReferenceRig();
  rig.effects = {s.effect};
  Plant plant = BuildPlant(TrueRig(rig));
  MotionState m{};
  m.q[0] = 4e-5;  // 30 um and -40 um from the motor's centre
  m.q[1] = -6e-5;
  RotorForces forces;
  forces.Q = {};
  for (const auto& term : plant.rotor.terms) term->Add(m, forces);
  const double r = 5e-5, f = s.value(s.Sizes(), r);
  EXPECT_NEAR(forces.Q[0], f * 0.6, 1e-9 * f);
  EXPECT_NEAR(forces.Q[1], -f * 0.8, 1e-9 * f);
}

RotorForces ForcesOf(const EffectInstance& e, double theta) {
  RigParameters rig = ReferenceRig();
  rig.effects = {e};
  const Plant plant = BuildPlant(TrueRig(rig));
  MotionState m{};
  m.theta = theta;
  RotorForces forces;
  forces.Q = {};
  for (const auto& term : plant.rotor.terms) term->Add(m, forces);
  return forces;
}

// It starts at the catalogue's force, and other orders turn as the curve says: forward ones with
// the shaft, backward ones against it.
TEST(Shape, TheSeriesOfACouplingIsThatOfTheCurve) {
  const EffectInstance law = Named("coupling-misalignment", {{"c", 3}, {"s", -1}});
  Shape s = ShapeOf(law, ReferenceRig(), {});
  const auto row = [&](const std::string& name) {
    return static_cast<std::size_t>(
        std::ranges::find(s.effect.table, name, &EffectParameter::name) - s.effect.table.begin());
  };
  for (const double theta : {0.0, 0.4, 2.5}) {
    const RotorForces a = ForcesOf(law, theta), b = ForcesOf(s.effect, theta);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(a.Q[k], b.Q[k], 1e-12);
    EXPECT_NEAR(s.value(s.Sizes(), theta), a.Q[0], 1e-12);
  }
  for (double& v : s.effect.values) v = 0;
  s.effect.values[row("c3")] = 2;
  s.effect.values[row("s1b")] = 5;
  const double theta = 0.7;
  const RotorForces f = ForcesOf(s.effect, theta);
  EXPECT_NEAR(f.Q[0], 2 * std::cos(3 * theta) + 5 * std::sin(theta), 1e-12);
  EXPECT_NEAR(f.Q[1], 2 * std::sin(3 * theta) + 5 * std::cos(theta), 1e-12);
  EXPECT_NEAR(s.value(s.Sizes(), theta), f.Q[0], 1e-12);
}

TEST(Shape, RefusesWhatHasNoCurve) {
  EXPECT_THROW(ShapeOf(Named("loop-delay", {}, "rig"), ReferenceRig(), {}), InputError);
  EXPECT_THROW(ShapeOf(Named("saturation", {{"knee", 0.5}}), ReferenceRig(), {}), InputError);
  EXPECT_THROW(ShapeOf(Named("side-pull", {{"stiffness", 1e4}}), ReferenceRig(), {}), InputError);
}

}  // namespace
}  // namespace ambrig
