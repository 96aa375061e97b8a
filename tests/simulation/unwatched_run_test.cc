// Runs without fault detection say so, or are refused where the scenario asks for what only it can
// give.
#include <gmock/gmock.h>

#include "simulation/simulate.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kA3Opens = "[[fault]]\ntime = 0.002\ntarget = \"A.coil3\"\nkind = \"open\"\n";

RigParameters RigOfModulation(const std::string& modulation) {
  std::string text = ReferenceText();
  const std::string old = "modulation = \"bi-state\"";
  EXPECT_NE(text.find(old), std::string::npos);
  text.replace(text.find(old), old.size(), "modulation = \"" + modulation + "\"");
  return ReadRigText(text, "rig.toml");
}

RunResult ShortRun(const std::string& modulation, const std::string& more,
                   Fidelity fidelity = Fidelity::kSwitching) {
  const RigParameters rig = RigOfModulation(modulation);
  SimulateOptions options;
  options.fidelity = fidelity;
  return Simulate(rig, ReadScenarioText("duration = 0.004\n" + more, "s.toml", rig), options);
}

auto Tells(const char* why) {
  return Contains(AllOf(HasSubstr("no fault detection in this run"), HasSubstr(why)));
}

TEST(UnwatchedRun, IsNotedWithItsReason) {
  for (const char* modulation : {"tri-state", "chopper", "ideal"})
    for (const std::string& fault : {kA3Opens, std::string()})
      EXPECT_THAT(ShortRun(modulation, fault).notes, Tells("it needs bi-state amplifiers"))
          << modulation;
  EXPECT_THAT(ShortRun("bi-state", kA3Opens, Fidelity::kAveraged).notes,
              Tells("--fidelity averaged has none"));
  EXPECT_THAT(ShortRun("bi-state", "[start]\nstate = \"clamped\"\n" + kA3Opens).notes,
              Tells("the rotor is clamped"));
}

TEST(UnwatchedRun, IsNoSurpriseToWhoAskedForItAndWatchedRunsSayNothing) {
  EXPECT_THAT(ShortRun("bi-state", kA3Opens).notes, IsEmpty());
  EXPECT_THAT(ShortRun("tri-state", "fault_tolerance = false\n" + kA3Opens).notes, IsEmpty());
  EXPECT_THAT(ShortRun("bi-state", "[start]\nstate = \"clamped\"\n").notes, IsEmpty());
}

// The reader of a scenario does not know the fidelity of a run.
TEST(UnwatchedRun, IsRefusedWhereTheScenarioAsksForDetection) {
  for (const Fidelity fidelity : {Fidelity::kAveraged, Fidelity::kReference}) {
    try {
      ShortRun("bi-state", kA3Opens + "[expect]\nclassified = \"open\"\n", fidelity);
      ADD_FAILURE() << "no error";
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr("s.toml: expect.classified asks for fault detection"));
      EXPECT_THAT(e.what(), HasSubstr("allowed: --fidelity switching"));
    }
  }
  EXPECT_NO_THROW(ShortRun("bi-state", "[expect]\ndrop = false\n", Fidelity::kAveraged));
  EXPECT_NO_THROW(ShortRun("bi-state", "fault_tolerance = false\n[expect]\nclassified = \"open\"\n",
                           Fidelity::kAveraged));
}

}  // namespace
}  // namespace ambrig
