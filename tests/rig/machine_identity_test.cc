// Which machine a rig file describes beside its nominal values.
#include "rig/machine_identity.h"

#include <gtest/gtest.h>

#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

Tolerance Fitted(const std::string& path, double value) {
  Tolerance t;
  t.path = path;
  t.true_value = value;
  return t;
}

TEST(MachineIdentity, OfOneMachineDoesNotDiffer) {
  RigParameters rig = WithEffect(ReferenceRig(), "fringing", "A", {{"coefficient", 0.1}});
  rig.tolerances.push_back(Fitted("bearings.A.gap", 4.1e-4));
  EXPECT_EQ(DifferenceOf(IdentityOf(rig), IdentityOf(rig), "A"), "");
}

TEST(MachineIdentity, EffectsCountAtTheirBearing) {
  const RigParameters rig = ReferenceRig();
  const RigParameters now = WithEffect(rig, "eddy-currents", "A", {{"cutoff", 3000}});
  EXPECT_EQ(DifferenceOf(IdentityOf(rig), IdentityOf(now), "A"), "effects (eddy-currents at A)");
  EXPECT_EQ(DifferenceOf(IdentityOf(now), IdentityOf(rig), "A"), "effects (eddy-currents at A)");
  EXPECT_EQ(DifferenceOf(IdentityOf(rig), IdentityOf(now), "B"), "");
  const RigParameters other = WithEffect(rig, "eddy-currents", "A", {{"cutoff", 2000}});
  EXPECT_EQ(DifferenceOf(IdentityOf(other), IdentityOf(now), "A"), "effects (eddy-currents at A)");
}

// The motion of the shaft is measured, whatever moves it.
TEST(MachineIdentity, WhatMovesTheShaftAloneDoesNotCount) {
  const RigParameters rig = ReferenceRig();
  const RigParameters now = WithEffect(rig, "unbalance", "A", {{"c", 1e-5}});
  EXPECT_EQ(DifferenceOf(IdentityOf(rig), IdentityOf(now), "A"), "");
}

TEST(MachineIdentity, FittedValuesCountAtTheirBearingAndOfTheAmplifierAtAll) {
  const RigParameters rig = ReferenceRig();
  RigParameters now = rig;
  now.tolerances.push_back(Fitted("bearings.A.gap", 4.1e-4));
  now.tolerances.push_back(Fitted("rotor.mass", 4.3));
  EXPECT_EQ(DifferenceOf(IdentityOf(rig), IdentityOf(now), "A"), "fitted values (bearings.A.gap)");
  EXPECT_EQ(DifferenceOf(IdentityOf(rig), IdentityOf(now), "B"), "");
  now.tolerances.push_back(Fitted("amplifier.diode_drop", 0.8));
  EXPECT_EQ(DifferenceOf(IdentityOf(rig), IdentityOf(now), "B"),
            "fitted values (amplifier.diode_drop)");
}

TEST(MachineIdentity, TheUnitCountsWhereItsDrawsDo) {
  RigParameters rig = ReferenceRig(), now = rig;
  for (RigParameters* r : {&rig, &now})
    r->amplifier.edge_spread = r->amplifier.current_gain_spread = 0;
  now.amplifier.unit = 14;
  EXPECT_EQ(DifferenceOf(IdentityOf(rig), IdentityOf(now), "A"), "");
  now.amplifier.current_gain_spread = 0.005;
  EXPECT_EQ(DifferenceOf(IdentityOf(rig), IdentityOf(now), "A"), "unit (1, now 14)");
}

// Files of earlier versions do not say.
TEST(MachineIdentity, OfAnUnknownMachineNothingIsSaid) {
  const RigParameters now = WithEffect(ReferenceRig(), "fringing", "A", {{"coefficient", 0.1}});
  EXPECT_EQ(DifferenceOf(MachineIdentity{}, IdentityOf(now), "A"), "");
}

}  // namespace
}  // namespace ambrig
