// Expectations that only fault detection can meet are refused where none watches the run.
#include "scenarios/expect_file.h"

#include <gmock/gmock.h>

#include "core/base/errors.h"
#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

std::string ExpectMessage(const std::string& text, Modulation modulation = Modulation::kBiState) {
  RigParameters rig = ReferenceLanesRig();
  rig.amplifier.modulation = modulation;
  try {
    ReadScenarioText("duration = 0.5\n" + text, "run.toml", rig);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no mistake";
}

TEST(ExpectFile, KeysOfFaultDetectionNeedOne) {
  for (const auto& [key, value] : {std::pair{"detected_within", "0.002"},
                                   {"classified", "\"open\""},
                                   {"redistributed", "true"}}) {
    const std::string expect = std::string("[expect]\n") + key + " = " + value + "\n";
    const std::string asks =
        std::string("expect.") + key + ": asks for fault detection, which this ";
    EXPECT_EQ(ExpectMessage(expect), "no mistake");
    EXPECT_THAT(ExpectMessage(expect, Modulation::kTriState), HasSubstr("run.toml:3: " + asks));
    EXPECT_THAT(ExpectMessage(expect, Modulation::kTriState), HasSubstr("bi-state amplifiers"));
    const std::string clamped = "[start]\nstate = \"clamped\"\n" + expect;
    EXPECT_THAT(ExpectMessage(clamped), HasSubstr("run.toml:5: " + asks));
    EXPECT_THAT(ExpectMessage(clamped), HasSubstr("the rotor is clamped"));
  }
}

TEST(ExpectFile, WhatARunWithoutDetectionCanMeetIsAllowed) {
  EXPECT_EQ(ExpectMessage("[expect]\nredistributed = false\nmax_false_alarms = 0\ndrop = false\n",
                          Modulation::kTriState),
            "no mistake");
}

// Whoever takes the answer away wants to see what is missed.
TEST(ExpectFile, ARunThatWantsNoDetectionMayMissIt) {
  for (const Modulation m : {Modulation::kBiState, Modulation::kTriState})
    EXPECT_EQ(ExpectMessage("fault_tolerance = false\n[expect]\nclassified = \"open\"\n", m),
              "no mistake");
}

TEST(ExpectFile, ARunIsWatchedUnlessSomethingSpeaksAgainstIt) {
  RigParameters rig = ReferenceLanesRig();
  Scenario s;
  EXPECT_EQ(WhyUnwatched(rig, s), "");
  for (const Modulation m : {Modulation::kTriState, Modulation::kChopper, Modulation::kIdeal}) {
    rig.amplifier.modulation = m;
    EXPECT_THAT(WhyUnwatched(rig, s), HasSubstr("bi-state"));
  }
}

}  // namespace
}  // namespace ambrig
