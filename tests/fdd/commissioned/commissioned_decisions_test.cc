// What the commissioned detector decides of one coil: class, coil, delay, and when it keeps silent.
// The plants are the switching engine with eddy currents, fringing, hysteresis and moved sensors.
#include <gtest/gtest.h>

#include <map>

#include "tests/fdd/commissioned_plant.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_plant;

constexpr double kPeriod = 40e-6;  // [s]

struct FaultCase {
  const char *kind, *parameters;
  FaultClass cls;
  double within;  // [s]
};

void ExpectFound(const CommissionedRig& plant, const FaultCase& c, int coil) {
  const auto seen =
      Concluded(plant.rig, &plant.bearing, Operation(FaultOf(coil, c.kind, c.parameters)));
  const std::string what = fmt::format("{} {} coil {}", c.kind, c.parameters, coil);
  ASSERT_FALSE(seen->found.empty()) << what;
  EXPECT_EQ(seen->Coils(), std::set<int>{coil}) << what;
  const Diagnosis& d = seen->found.front();
  EXPECT_EQ(d.cls, c.cls) << what << ": " << ToText(d.cls);
  EXPECT_GT(d.time, kOnset) << what;
  EXPECT_LT(d.time - kOnset, c.within) << what;
  EXPECT_LT(d.onset, d.time) << what;
  EXPECT_GT(d.onset, kOnset - 2 * kPeriod) << what;
}

constexpr FaultCase kFaults[] = {
    {"open", "", FaultClass::kOpen, 0.25e-3},
    {"amplifier-off", "", FaultClass::kOpen, 0.4e-3},  // or its own class: see below
    {"partial-short", "fraction = 0.5", FaultClass::kPartialShort, 0.25e-3},
    {"partial-short", "fraction = 0.1", FaultClass::kPartialShort, 0.5e-3},
    {"partial-short", "fraction = 0.1, short_resistance = 0.05", FaultClass::kPartialShort, 0.5e-3},
    {"current-sensor", "gain = 0.8", FaultClass::kCurrentSensor, 1e-3}};

TEST(CommissionedDecisions, FaultsOfAMachineWithSlowIronAreNamed) {
  for (const FaultCase& c : kFaults)
    if (std::string(c.kind) != "amplifier-off") ExpectFound(SlowIron(), c, 3);
}

TEST(CommissionedDecisions, FaultsOfAMachineOfThinSheetsAreNamed) {
  for (const FaultCase& c : kFaults)
    if (std::string(c.kind) != "amplifier-off") ExpectFound(ThinSheets(), c, 6);
}

// A bridge that is off drives the current down; once that is gone, it looks like an open coil.
TEST(CommissionedDecisions, ADeadAmplifierIsNamedAsSuchOrAsAnOpenCoil) {
  for (const CommissionedRig* plant : {&SlowIron(), &ThinSheets()}) {
    const auto seen =
        Concluded(plant->rig, &plant->bearing, Operation(FaultOf(2, "amplifier-off")));
    ASSERT_FALSE(seen->found.empty());
    EXPECT_EQ(seen->Coils(), std::set<int>{2});
    EXPECT_TRUE(seen->found[0].cls == FaultClass::kAmplifierOff ||
                seen->found[0].cls == FaultClass::kOpen);
    EXPECT_LT(seen->found[0].time - kOnset, 0.4e-3);
  }
}

// Two volts that no duty shows are seven per cent of the slope: learnt, where the plant cannot be
// expressed without.
TEST(CommissionedDecisions, BridgesThatAddAVoltageAreLearnt) {
  for (const double offset : {2.0, -2.0}) {
    const CommissionedRig plant(
        WithEffect(ReferenceRig(), "amplifier-offset", "A", {{"offset", offset}}));
    ASSERT_TRUE(plant.bearing.usable());
    EXPECT_LT(plant.bearing.grade, 1.5);
    for (int j = 0; j < 8; ++j)
      EXPECT_NEAR(plant.bearing.coils.offset[j], offset, 0.2) << "coil " << j + 1;
    EXPECT_TRUE(Concluded(plant.rig, &plant.bearing, Operation(""))->found.empty());
    for (const FaultCase& c : kFaults)
      if (std::string(c.kind) != "amplifier-off") ExpectFound(plant, c, 4);
  }
  for (int j = 0; j < 8; ++j) EXPECT_EQ(SlowIron().bearing.coils.offset[j], 0);
}

TEST(CommissionedDecisions, ShortsAreFoundWithTheirShareOfTheTurns) {
  for (const CommissionedRig* plant : {&SlowIron(), &ThinSheets()})
    for (const double share : {0.1, 0.2, 0.3, 0.5, 0.7}) {
      const auto seen =
          Concluded(plant->rig, &plant->bearing,
                    Operation(FaultOf(5, "partial-short", "fraction = " + std::to_string(share))));
      ASSERT_FALSE(seen->found.empty()) << share;
      EXPECT_EQ(seen->Coils(), std::set<int>{5}) << share;
      EXPECT_EQ(seen->found[0].cls, FaultClass::kPartialShort) << share;
      EXPECT_NEAR(seen->found[0].fraction, share, 0.03) << share;
    }
}

TEST(CommissionedDecisions, NothingIsConcludedOfAHealthyMachine) {
  for (const CommissionedRig* plant : {&SlowIron(), &ThinSheets()}) {
    ASSERT_TRUE(plant->bearing.usable());
    const auto seen = Concluded(plant->rig, &plant->bearing, Operation("", 0.08));
    EXPECT_TRUE(seen->periods.empty());
    EXPECT_FALSE(seen->doubted);
    // Nor by the detector that was never commissioned; it doubts its model all the time.
    const auto stranger = Concluded(plant->rig, nullptr, Operation("", 0.08));
    EXPECT_TRUE(stranger->found.empty());
    EXPECT_TRUE(stranger->doubted);
  }
}

/// Eddy currents from 300 Hz on and less leakage than drawn: beside an edge the current steps by
/// more than V h/L_leak.
const CommissionedRig& ThickSheets() {
  static const CommissionedRig made([] {
    RigParameters rig = WithEffect(ReferenceRig(), "eddy-currents", "A", {{"cutoff", 300}});
    for (Tolerance& t : rig.tolerances)
      if (t.path == "bearings.A.leakage_inductance") t.true_value = 2.9e-4;
    return rig;
  }());
  return made;
}

// It was taken for a current sensor that steps.
TEST(CommissionedDecisions, StepsBesideAnEdgeAreTheMachinesOwn) {
  const auto healthy = Concluded(ThickSheets().rig, &ThickSheets().bearing, Operation("", 0.08));
  EXPECT_TRUE(healthy->found.empty());
  EXPECT_FALSE(healthy->doubted);
  const auto stepped = Concluded(ThickSheets().rig, &ThickSheets().bearing,
                                 Operation(FaultOf(3, "current-sensor", "offset = 0.4")));
  EXPECT_EQ(stepped->Coils(), std::set<int>{3});
}

// Three periods in a row: a reading that is wrong in one or two of them is no fault.
TEST(CommissionedDecisions, ADecisionTakesThreePeriods) {
  for (const char* kind : {"open", "partial-short"}) {
    const auto seen =
        Concluded(SlowIron().rig, &SlowIron().bearing,
                  Operation(FaultOf(3, kind, kind == std::string("open") ? "" : "fraction = 0.5")));
    ASSERT_FALSE(seen->found.empty());
    EXPECT_GE(seen->found[0].time - seen->found[0].onset, 2.99 * kPeriod) << kind;
  }
  // An amplifier that fails for a single period.
  const auto brief = Concluded(SlowIron().rig, &SlowIron().bearing,
                               Operation(FaultOf(3, "amplifier-off", "duration = 3.5e-5")));
  EXPECT_TRUE(brief->found.empty());
}

// Bands stand at 1.5 times what healthy running reached: a wide commissioning hides small shorts
// only.
TEST(CommissionedDecisions, BandsOfCommissioningDecideWhatIsSmall) {
  CommissionedBearing wide = SlowIron().bearing;
  for (Lane& largest : wide.largest)
    for (double& v : largest.v) v = 0.4;  // bands of 0.6; c of a tenth of the turns is 0.23
  const auto concluded = [&](const CommissionedBearing& b, const char* fraction) {
    return Concluded(SlowIron().rig, &b, Operation(FaultOf(3, "partial-short", fraction)));
  };
  EXPECT_TRUE(concluded(wide, "fraction = 0.1")->found.empty());
  EXPECT_EQ(concluded(wide, "fraction = 0.5")->Coils(), std::set<int>{3});
  EXPECT_EQ(concluded(SlowIron().bearing, "fraction = 0.1")->Coils(), std::set<int>{3});
}

// A model that is doubted - a bad fit, flux outside its range, none at all - acts on gross faults.
TEST(CommissionedDecisions, ADoubtedModelConcludesGrossFaultsOnly) {
  CommissionedBearing bad = SlowIron().bearing, narrow = SlowIron().bearing;
  bad.grade = kWorstGrade + 1;
  for (double& v : narrow.largest_flux.v) v *= 0.2;
  for (const CommissionedBearing* b : {&bad, &narrow}) {
    const auto small =
        Concluded(SlowIron().rig, b, Operation(FaultOf(3, "partial-short", "fraction = 0.1")));
    EXPECT_TRUE(small->found.empty());
    EXPECT_TRUE(small->doubted);
    const auto open = Concluded(SlowIron().rig, b, Operation(FaultOf(3, "open")));
    ASSERT_FALSE(open->found.empty());
    EXPECT_EQ(open->Coils(), std::set<int>{3});
    EXPECT_EQ(open->found[0].cls, FaultClass::kOpen);
    EXPECT_LT(open->found[0].time - kOnset, 0.5e-3);
    EXPECT_FALSE(open->periods[0].doubtful);  // what stands in spite of the doubt is acted on
  }
}

// The second fault is judged against the coils that are left.
TEST(CommissionedDecisions, AFaultAfterAnotherIsFoundBesideIt) {
  for (const auto& [first, second] :
       {std::pair{"partial-short", "open"}, std::pair{"partial-short", "partial-short"},
        std::pair{"open", "partial-short"}}) {
    const auto parameters = [](const std::string& kind) {
      return kind == "open" ? "" : "fraction = 0.5";
    };
    const auto seen = Concluded(SlowIron().rig, &SlowIron().bearing,
                                Operation(FaultOf(3, first, parameters(first)) +
                                              FaultOf(6, second, parameters(second), 0.0340077),
                                          0.042));
    EXPECT_EQ(seen->Coils(), (std::set<int>{3, 6})) << first << " " << second;
    ASSERT_EQ(seen->found.size(), 2U) << first << " " << second;
    EXPECT_EQ(ToText(seen->found[0].cls), std::string(first));
    EXPECT_EQ(ToText(seen->found[1].cls), std::string(second));
    EXPECT_LT(seen->found[1].time - 0.0340077, 0.5e-3);
  }
}

// Two coils that lose few turns at one instant are named together: a coil that stands out first
// waits for the other, whose windows would begin anew after it. A healthy neighbour keeps no coil
// waiting.
TEST(CommissionedDecisions, TwoSmallShortsAtOneInstantAreNamedTogether) {
  for (const CommissionedRig* plant : {&SlowIron(), &ThinSheets()})
    for (const int other : {2, 3, 4, 5}) {
      const auto seen = Concluded(plant->rig, &plant->bearing,
                                  Operation(FaultOf(1, "partial-short", "fraction = 0.1") +
                                            FaultOf(other, "partial-short", "fraction = 0.1")));
      EXPECT_EQ(seen->Coils(), (std::set<int>{1, other})) << other;
      ASSERT_EQ(seen->found.size(), 2U) << other;
      for (const Diagnosis& d : seen->found) EXPECT_LT(d.time - kOnset, 0.5e-3) << other;
    }
}

// A step of a sensor's offset has no slope: the reading itself jumps, by more than the current does
// where eddy currents leave little inductance.
TEST(CommissionedDecisions, AStepOfACurrentSensorIsNamed) {
  for (const CommissionedRig* plant : {&SlowIron(), &ThinSheets()})
    for (const int coil : {3, 6})
      for (const char* step : {"offset = 0.3", "offset = -0.3"}) {
        const auto seen = Concluded(plant->rig, &plant->bearing,
                                    Operation(FaultOf(coil, "current-sensor", step)));
        ASSERT_FALSE(seen->found.empty()) << step << " coil " << coil;
        EXPECT_EQ(seen->Coils(), std::set<int>{coil}) << step;
        EXPECT_EQ(seen->found[0].cls, FaultClass::kCurrentSensor) << step;
        EXPECT_LT(seen->found[0].time - kOnset, 0.5e-3) << step;
      }
}

// A loop of shorted turns carries a current of its own, which keeps ripple out of the pole: the
// slopes are those of a coil with fewer turns than are left. Class and coil are right.
TEST(CommissionedDecisions, AClosedLoopLooksLikeALargerShort) {
  const auto seen =
      Concluded(ThinSheets().rig, &ThinSheets().bearing,
                Operation(FaultOf(5, "partial-short", "fraction = 0.3, short_resistance = 0.05")));
  ASSERT_FALSE(seen->found.empty());
  EXPECT_EQ(seen->Coils(), std::set<int>{5});
  EXPECT_EQ(seen->found[0].cls, FaultClass::kPartialShort);
  EXPECT_GT(seen->found[0].ripple_fraction, 0.3);
  EXPECT_LT(seen->found[0].ripple_fraction, 0.7);
  EXPECT_LT(seen->found[0].fraction, 0.3);
}

}  // namespace
}  // namespace ambrig
