// The numbers that a fit may move: which are free, their priors, bounds and coordinates, for every
// effect of the catalogue (residual_test.cc has what one of them does).
#include <gmock/gmock.h>

#include <cmath>

#include "discovery/model/case_model.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

RigParameters RigWith(const std::vector<Tolerance>& tolerances) {
  RigParameters rig = ReferenceRig();
  rig.tolerances = tolerances;
  return rig;
}

TEST(Hypothesis, TolerancesAreFreeWithTheirPrior) {
  const Hypothesis h = Hypothesis::Base(RigWith({{"rotor.mass", 0.01, kRequired},
                                                 {"rotor.inertia_polar", 0, kRequired},
                                                 {"no.such.number", 1, kRequired},
                                                 {"bearings.A.gap", 1e-4, kRequired}}));
  ASSERT_EQ(h.free.size(), 2u);  // without an sd nothing is free
  const FreeParameter &mass = h.free[0], &gap = h.free[1];
  EXPECT_EQ(mass.path, "rotor.mass");
  EXPECT_EQ(mass.effect, -1);
  EXPECT_EQ(mass.value, 4.2);
  EXPECT_EQ(mass.sd, 0.01);
  EXPECT_EQ(mass.step, 0.01);
  EXPECT_DOUBLE_EQ(mass.lo, 4.2 - 0.08);
  EXPECT_DOUBLE_EQ(mass.hi, 4.2 + 0.08);
  EXPECT_EQ(gap.lo, 1e-6);  // what a gap may be at all
  EXPECT_DOUBLE_EQ(gap.hi, 4e-4 + 8e-4);
  EXPECT_FALSE(mass.logarithmic || gap.logarithmic);
}

// Of the file's own effects only what has an sd is free, and every number of a formula.
TEST(Hypothesis, EffectsOfTheFileAreFreeWhereTheySayHowWellTheyAreKnown) {
  RigParameters rig = RigWith({});
  EffectInstance known = MakeInstance(EffectNamed("sensor-gain"), "A.x");
  known.Set("gain", 1.02);
  EffectInstance unsure = MakeInstance(EffectNamed("sensor-offset"), "A.y");
  unsure.Set("offset", 1e-6);
  unsure.sd[0] = 1e-7;
  rig.effects = {known, unsure};
  const Hypothesis h = Hypothesis::Base(rig);
  ASSERT_EQ(h.rig.effects.size(), 2u);
  ASSERT_EQ(h.free.size(), 1u);
  EXPECT_EQ(h.free[0].effect, 1);
  EXPECT_EQ(h.free[0].path, "sensor-offset@A.y.offset");
}

/// Every parameter of the effect at the upper end of its usual range.
EffectInstance Strong(const EffectDescription& d, const std::string& target) {
  EffectInstance e = MakeInstance(d, target);
  for (std::size_t row = 0; row < e.table.size(); ++row) e.values[row] = e.table[row].typical_hi;
  return e;
}

TEST(Hypothesis, HoldsAnEffectByItsNameAndTarget) {
  Hypothesis h;
  h.AddEffect(MakeInstance(EffectNamed("sensor-gain"), "A.x"));
  EffectInstance other = MakeInstance(EffectNamed("sensor-gain"), "A.x");
  other.Set("gain", 1.2);
  EXPECT_TRUE(h.Holds(other));
  EXPECT_FALSE(h.Holds(MakeInstance(EffectNamed("sensor-gain"), "A.y")));
  EXPECT_FALSE(h.Holds(MakeInstance(EffectNamed("sensor-offset"), "A.x")));
}

// Every parameter of the catalogue: a coordinate leads back to its value, one unit of it is a ratio
// of e^0.3 or a step of three tenths of the usual size.
TEST(Hypothesis, CoordinatesAreRatiosOrSteps) {
  const RigParameters rig = RigWith({});
  const EffectTargets targets = TargetsOfEffects(rig);
  int ratios = 0, steps = 0;
  for (const EffectDescription& d : Catalogue()) {
    if (d.users_own || TargetsOf(d, targets).empty()) continue;
    Hypothesis h = Hypothesis::Base(rig);
    h.AddEffect(Strong(d, TargetsOf(d, targets)[0]));
    for (std::size_t k = 0; k < h.free.size(); ++k) {
      const FreeParameter p = h.free[k];
      EXPECT_EQ(h.Coordinate(k), 0) << p.path;
      const double there = h.ValueAt(k, -1);
      if (there <= p.lo || there >= p.hi) continue;
      if (p.logarithmic) {
        EXPECT_NEAR(there / p.start, std::exp(-0.3), 1e-12) << p.path;
        EXPECT_GT(p.lo, 0) << p.path;
        ++ratios;
      } else {
        EXPECT_NEAR(there, p.start - p.step, 1e-12 * std::abs(p.step)) << p.path;
        ++steps;
      }
      h.Set(k, there);
      EXPECT_NEAR(h.Coordinate(k), -1, 1e-9) << p.path;
      EXPECT_GT(p.step, 0) << p.path;
    }
  }
  EXPECT_GT(ratios, 10);
  EXPECT_GT(steps, 10);
}

// A gain of 1.02 is a distance from 1, not a size over decades; an offset may have either sign.
TEST(Hypothesis, DistancesFromANullAreSteps) {
  Hypothesis h = Hypothesis::Base(RigWith({}));
  h.AddEffect(Strong(EffectNamed("sensor-gain"), "A.x"));
  h.AddEffect(Strong(EffectNamed("sensor-offset"), "A.x"));
  for (const FreeParameter& p : h.free) EXPECT_FALSE(p.logarithmic) << p.path;
}

}  // namespace
}  // namespace ambrig
