// Windings of a thrust side: a loss of turns raises the c of both, and one without current has
// hardly any. The plant is the switching engine with effects.
#include <gtest/gtest.h>

#include "tests/fdd/commissioned_plant.h"

namespace ambrig {
namespace {

using namespace testing_plant;

constexpr int kFalseZero = 2;  // the coil

/// Fringing, and a winding whose sensor reads 0.2 A when it has no current.
const CommissionedRig& ThrustPlant() {
  static const CommissionedRig made(
      [] {
        RigParameters rig = WithEffect(ReferenceRig(), "fringing", "Z", {{"coefficient", 0.15}});
        return WithEffect(rig, "current-sensor-offset", "Z.coil2", {{"offset", 0.2}});
      }(),
      "Z");
  return made;
}

void ExpectFoundWithin(int coil, const std::string& kind, const std::string& parameters,
                       double most) {
  const auto seen = Concluded(ThrustPlant().rig, &ThrustPlant().bearing,
                              Operation(FaultOf(coil, kind, parameters, kOnset, "Z"), 0.05));
  ASSERT_EQ(seen->Coils(), std::set<int>{coil}) << kind << parameters;
  const FaultClass wanted = kind == "open" ? FaultClass::kOpen : FaultClass::kPartialShort;
  // a reading that stays at 0.2 A may be its sensor's fault as well
  const bool either = kind == "open" && coil == kFalseZero;
  EXPECT_TRUE(either || seen->found[0].cls == wanted) << coil << kind << parameters;
  EXPECT_GT(seen->found[0].time, kOnset);
  EXPECT_LT(seen->found[0].time - kOnset, most) << coil << kind << parameters;
}

TEST(ThrustWindings, OpensAndShortsAreFoundInTime) {
  for (int coil = 1; coil <= 4; ++coil) {
    ExpectFoundWithin(coil, "open", "", 0.25e-3);
    ExpectFoundWithin(coil, "partial-short", "fraction = 0.5", 0.25e-3);
    ExpectFoundWithin(coil, "partial-short", "fraction = 0.1", 0.5e-3);
    ExpectFoundWithin(coil, "partial-short", "fraction = 0.04", 3e-3);
  }
}

// An error of the share that a winding has left is in the c of both windings of its side: a loss of
// the other one is not named for 2500 periods, the model is doubtful instead. The other side is
// judged as ever.
TEST(ThrustWindings, NoSecondLossOnOneSideIsNamedSoonAfterTheFirst) {
  constexpr double kWait = 2500 / 25e3;  // [s]
  const auto seen = [](int second) {
    return Concluded(
        ThrustPlant().rig, &ThrustPlant().bearing,
        Operation(FaultOf(1, "partial-short", "fraction = 0.4", kOnset, "Z") +
                      FaultOf(second, "partial-short", "fraction = 0.6", 0.0500077, "Z"),
                  0.14));
  };
  const auto same = seen(2), other = seen(3);
  ASSERT_EQ(same->Coils(), (std::set<int>{1, 2}));
  EXPECT_GT(same->found[1].time, same->found[0].time + kWait - 0.5e-4);
  EXPECT_LT(same->found[1].time, same->found[0].time + kWait + 1e-3);
  EXPECT_TRUE(same->doubted);
  ASSERT_EQ(other->Coils(), (std::set<int>{1, 3}));
  EXPECT_LT(other->found[1].time, 0.0510077);
}

// A loop of shorted turns keeps the ripple out of the flux of both windings: by their slopes each
// has lost half of its turns. The other winding is whole, and what carries is told afterwards.
TEST(ThrustWindings, ALoopInOneWindingIsNoLossOfBoth) {
  for (const int coil : {1, 4})
    for (const char* loop :
         {"fraction = 0.2, short_resistance = 0.02", "fraction = 0.1, short_resistance = 0.01"}) {
      const auto seen =
          Concluded(ThrustPlant().rig, &ThrustPlant().bearing,
                    Operation(FaultOf(coil, "partial-short", loop, kOnset, "Z"), 0.06));
      ASSERT_EQ(seen->Coils(), std::set<int>{coil}) << loop;
      EXPECT_LT(seen->found[0].fraction, 0.15) << loop;
      EXPECT_GT(seen->found[0].ripple_fraction, 0.3) << loop;
      for (const auto& [other, carried] : seen->carried) {
        EXPECT_EQ(other + 1, coil) << loop;
        EXPECT_GT(carried, 0.65) << loop;  // grid of 0.05
      }
    }
}

TEST(ThrustWindings, HalfOfTheTurnsOfBothAreTold) {
  const auto seen =
      Concluded(ThrustPlant().rig, &ThrustPlant().bearing,
                Operation(FaultOf(3, "partial-short", "fraction = 0.5", kOnset, "Z") +
                              FaultOf(4, "partial-short", "fraction = 0.5", kOnset, "Z"),
                          0.04));
  ASSERT_EQ(seen->Coils(), (std::set<int>{3, 4}));
  for (const Diagnosis& d : seen->found) EXPECT_NEAR(d.fraction, 0.5, 0.06);
}

TEST(ThrustWindings, AHealthyBearingIsLeftAlone) {
  const auto seen = Concluded(ThrustPlant().rig, &ThrustPlant().bearing, Operation("", 0.1));
  EXPECT_TRUE(seen->found.empty());
}

}  // namespace
}  // namespace ambrig
