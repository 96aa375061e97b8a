// When the commissioned detector keeps silent although its numbers look like a fault: supplies that
// fail, readings that are a little low, machines that bounce. The plants are the switching engine
// with effects.
#include <gtest/gtest.h>

#include "core/base/read_file.h"
#include "tests/fdd/commissioned_plant.h"

namespace ambrig {
namespace {

using namespace testing_plant;

// At 1 V the drops of switches and diodes are most of what a coil sees.
TEST(CommissionedRestraint, NothingIsConcludedWhileTheSupplyFails) {
  const std::string sag =
      "[[fault]]\ntarget = \"rig\"\ntime = 0.02\nkind = \"bus-sag\"\n"
      "parameters = { voltage = 1.0, duration = 0.01 }\n";
  for (const CommissionedRig* plant : {&SlowIron(), &ThinSheets()})
    EXPECT_TRUE(Concluded(plant->rig, &plant->bearing, Operation(sag, 0.06))->found.empty());
  // What opens meanwhile is found when it is back.
  const auto opened = Concluded(SlowIron().rig, &SlowIron().bearing,
                                Operation(sag + FaultOf(3, "open", "", 0.025), 0.06));
  EXPECT_EQ(opened->Coils(), std::set<int>{3});
}

// A coil that works is not given up for a reading that is low by a few percent.
TEST(CommissionedRestraint, ALowReadingIsNoFaultUntilItMatters) {
  for (const CommissionedRig* plant : {&SlowIron(), &ThinSheets()}) {
    const auto little = Concluded(plant->rig, &plant->bearing,
                                  Operation(FaultOf(3, "current-sensor", "gain = 0.95"), 0.08));
    EXPECT_TRUE(little->found.empty());
    const auto much = Concluded(plant->rig, &plant->bearing,
                                Operation(FaultOf(3, "current-sensor", "gain = 0.88"), 0.08));
    EXPECT_EQ(much->Coils(), std::set<int>{3});
  }
}

// Saturating iron loses its rotor, and idle coils whose current stays zero were taken for open
// ones.
TEST(CommissionedRestraint, NothingIsConcludedOfAStrangerThatBounces) {
  const std::string campaigns = std::string(AMBRIG_SOURCE_DIR) + "/scenarios/campaigns/";
  RigParameters rig = ReadRig(campaigns + "inexact/rig.toml");
  for (const char* bearing : {"A", "B"}) {
    rig = WithEffect(rig, "saturation", bearing, {{"knee", 0.25}});
    rig = WithEffect(rig, "unbalance", bearing, {{"c", 1e-5}, {"s", 5e-6}});
  }
  for (const char* operation : {"whirl", "load_steps", "run_up"}) {
    const std::string text = ReadFile(campaigns + "reality/" + operation + ".toml");
    const auto seen = Concluded(rig, nullptr, text);
    EXPECT_TRUE(seen->doubted) << operation;
    EXPECT_TRUE(seen->found.empty()) << operation;
  }
}

// Sensors that see three lobes, which no run-out of the circuit has: the fit is refused. What half
// of the turns make of c is no error of a motion that is read wrong, although the current keeps to
// its set-point.
TEST(CommissionedRestraint, HalfOfTheTurnsAreMissedByAModelThatIsRefusedToo) {
  const CommissionedRig plant(
      WithEffect(ReferenceRig(), "sensor-runout", "A", {{"c3", 1.2e-5}, {"s3", 1.2e-5}}));
  ASSERT_TRUE(plant.bearing.learnt);
  ASSERT_FALSE(plant.bearing.usable()) << plant.bearing.grade;
  const auto half = Concluded(plant.rig, &plant.bearing,
                              Operation(FaultOf(3, "partial-short", "fraction = 0.5")));
  ASSERT_FALSE(half->found.empty());
  EXPECT_EQ(half->Coils(), std::set<int>{3});
  EXPECT_EQ(half->found[0].cls, FaultClass::kPartialShort);
  EXPECT_NEAR(half->found[0].fraction, 0.5, 0.05);
  EXPECT_LT(half->found[0].time - kOnset, 0.25e-3);
  const auto healthy = Concluded(plant.rig, &plant.bearing, Operation("", 0.08));
  EXPECT_TRUE(healthy->found.empty());
  EXPECT_TRUE(healthy->doubted);
}

}  // namespace
}  // namespace ambrig
