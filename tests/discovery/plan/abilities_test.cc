// What records show that a rig can do, and what is stated of one without records.
#include "discovery/plan/abilities.h"

#include <gmock/gmock.h>

#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;

CaseRecord Recorded(const RigParameters& rig, const std::string& start, const std::string& more,
                    double rate = 12500) {
  CaseRecord r;
  r.scenario =
      ReadScenarioText("name = \"r\"\nrig = \"rig.toml\"\nduration = 0.1\nrecord_rate = 12500.0\n" +
                           start + "[speed]\nprofile = [[0.0, 0.0], [0.1, 0.0]]\n" + more,
                       "r.toml", rig);
  r.data.rate = rate;
  r.data.channels = {{"A.x", "m", {0, 0}}};
  return r;
}

std::string StepOf(const std::string& target, const std::string& port, double amplitude) {
  return "[[excitation]]\ntarget = \"" + target + "\"\nport = \"" + port +
         "\"\nkind = \"step\"\nstart = 0.0\nstop = 0.1\namplitude = " + std::to_string(amplitude) +
         "\n";
}

constexpr const char* kClampedAt =
    "[start]\nstate = \"clamped\"\nposition = { A = [4.0e-5, 0.0], B = [0.0, 1.0e-5] }\n";
constexpr const char* kClampedStart = "[start]\nstate = \"clamped\"\n";
constexpr const char* kLevitated = "[start]\nstate = \"levitated\"\n";
constexpr const char* kResting = "[start]\nstate = \"resting\"\n";

Abilities AbilitiesOf(const std::vector<CaseRecord>& records) {
  Case c;
  c.rig = ReferenceRig();
  c.records = records;
  return AbilitiesOf(c);
}

TEST(Abilities, OfEachKindOfStart) {
  const RigParameters rig = ReferenceRig();
  const Abilities landed = AbilitiesOf({Recorded(rig, kResting, "")});
  EXPECT_TRUE(landed.land);
  EXPECT_FALSE(landed.levitate || landed.clamp || landed.load || landed.reference);
  const Abilities driven = AbilitiesOf({Recorded(
      rig, kLevitated,
      StepOf("A.x", "reference", 1e-5) + "[[load]]\nplane = \"A\"\nforce = [5.0, 0.0]\n")});
  EXPECT_TRUE(driven.levitate && driven.load && driven.reference);
  EXPECT_FALSE(driven.land);
  const Abilities pushed = AbilitiesOf({Recorded(rig, kLevitated, StepOf("A.x", "force", 5))});
  EXPECT_FALSE(pushed.reference);  // another port
}

// The least current that some coil had all the time, the most that any had.
TEST(Abilities, CoilsOfAHeldRotorGoFromTheLeastToTheMostThatWasCommanded) {
  const RigParameters rig = ReferenceRig();
  const Abilities a =
      AbilitiesOf({Recorded(rig, kClampedStart,
                            StepOf("A.coil1", "current", 1.5) + StepOf("A.coil2", "current", 4) +
                                StepOf("B.coil1", "current", 0.5))});
  EXPECT_TRUE(a.clamp);
  EXPECT_EQ(a.coil_port, "current");
  EXPECT_DOUBLE_EQ(a.coil_least, 0.5);
  EXPECT_DOUBLE_EQ(a.coil_most, 4);
}

TEST(Abilities, AHeldRotorWithoutCommandsCannotBeCommanded) {
  EXPECT_FALSE(AbilitiesOf({Recorded(ReferenceRig(), kClampedStart, "")}).clamp);
}

TEST(Abilities, ItIsHeldWhereARecordHadItOffCentre) {
  const RigParameters rig = ReferenceRig();
  const std::string command = StepOf("A.coil1", "current", 2);
  for (const bool first : {true, false}) {
    std::vector<CaseRecord> records = {Recorded(rig, kClampedAt, command),
                                       Recorded(rig, kClampedStart, command)};
    if (!first) std::swap(records[0], records[1]);
    const Abilities a = AbilitiesOf(records);
    ASSERT_EQ(a.clamp_at.count("A"), 1u);
    EXPECT_THAT(a.clamp_at.at("A"), ElementsAre(4e-5, 0));
  }
}

TEST(Abilities, RatesOfBurstsAndOfLongRecordsAreApart) {
  const RigParameters rig = ReferenceRig();
  const std::string command = StepOf("A.coil1", "current", 2);
  const Abilities both = AbilitiesOf(
      {Recorded(rig, kClampedStart, command, 450000), Recorded(rig, kLevitated, "", 12500)});
  EXPECT_TRUE(both.burst);
  EXPECT_EQ(both.burst_rate, 450000);
  EXPECT_EQ(both.record_rate, 12500);
  const Abilities only = AbilitiesOf({Recorded(rig, kClampedStart, command, 450000)});
  EXPECT_EQ(only.record_rate, 450000);  // no other was shown
  EXPECT_FALSE(AbilitiesOf({Recorded(rig, kLevitated, "", 450000)}).burst);
}

TEST(Abilities, StatedOnes) {
  RigParameters rig = ReferenceRig();
  const Abilities free = StatedAbilities(rig, 700, false);
  EXPECT_TRUE(free.levitate && free.reference && free.land);
  EXPECT_FALSE(free.clamp || free.burst);
  EXPECT_EQ(free.top_speed, 700);
  EXPECT_EQ(free.record_rate, rig.controller.rate);
  EXPECT_TRUE(free.clamp_at.empty());
  const Abilities held = StatedAbilities(rig, 0, true);
  EXPECT_TRUE(held.clamp && held.burst);
  EXPECT_EQ(held.coil_port, "current");
  EXPECT_DOUBLE_EQ(held.coil_least, 0.2 * 6);
  EXPECT_DOUBLE_EQ(held.coil_most, 0.75 * 6);
  EXPECT_EQ(held.burst_rate, 25000 * 18);
  ASSERT_EQ(held.clamp_at.size(), 2u);  // not the thrust bearing
  EXPECT_THAT(held.clamp_at.at("B"), ElementsAre(0.4 * 2e-4, -0.3 * 2e-4));
  for (BearingParameters& b : rig.bearings) b.auxiliary.reset();
  EXPECT_FALSE(StatedAbilities(rig, 0, true).land);
  EXPECT_TRUE(StatedAbilities(rig, 0, true).clamp_at.empty());
}

}  // namespace
}  // namespace ambrig
