// A commissioning of another machine, or of an earlier state of this one, is told and not used.
#include "simulation/commissioning/other_machine.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "core/base/read_file.h"
#include "fdd/detectors/detection_feed.h"
#include "fdd/learning/commissioning_file.h"
#include "rig/machine_identity.h"
#include "simulation/simulate.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// The reference rig as a file of its own, with `added` to it.
std::string RigFile(const std::string& added) {
  const std::string file =
      ::testing::TempDir() + "/" + std::to_string(::getpid()) + "_machine.toml";
  std::ofstream(file) << ReadFile(std::string(AMBRIG_SOURCE_DIR) +
                                  "/scenarios/library/rigs/reference.toml")
                      << added;
  return file;
}

constexpr const char* kEddyCurrents =
    "\n[[effect]]\nname = \"eddy-currents\"\ntarget = \"A\"\nparameters = { cutoff = 3000.0 }\n";

/// What a commissioning of the rig in `file` would leave beside it, of the nominal circuit.
void Commissioned(const std::string& file, bool with_machine = true) {
  const NominalRig rig(ReadRig(file));
  CommissionedModel model;
  if (with_machine) model.machine = MachineOfFile(file);
  for (const BearingParameters& b : rig->bearings) {
    const LinkageModel m = LinkageModelOf(b);
    CommissionedBearing learnt = NominalBearing(b.name, m);
    learnt.learnt = true;
    learnt.grade = 0.5;
    learnt.learnt_on = ContentHashOf(m, rig->amplifier);
    for (int j = 0; j < m.coils; ++j) learnt.largest_flux[j] = 4;
    model.bearings.push_back(learnt);
  }
  std::ofstream(CommissioningFileOf(file)) << CommissioningText(model);
}

TEST(OtherMachine, AnEffectThatWasAddedSinceIsTold) {
  Commissioned(RigFile(""));
  const std::string file = RigFile(kEddyCurrents);
  const std::string note = OtherMachineNote(ReadRig(file));
  EXPECT_THAT(note, HasSubstr("bearing A: effects (eddy-currents at A)"));
  EXPECT_THAT(note, Not(HasSubstr("bearing B")));
  EXPECT_THAT(note, HasSubstr("run ambrig commission again"));
}

TEST(OtherMachine, OneThatHasItFromTheStartIsTheSame) {
  const std::string file = RigFile(kEddyCurrents);
  Commissioned(file);
  EXPECT_THAT(OtherMachineNote(ReadRig(file)), IsEmpty());
}

TEST(OtherMachine, AFileThatDoesNotSayIsTaken) {
  Commissioned(RigFile(""), false);
  EXPECT_THAT(OtherMachineNote(ReadRig(RigFile(kEddyCurrents))), IsEmpty());
}

// What a run would have taken for lost turns of eight coils.
TEST(OtherMachine, CountsAsNotCommissionedInARun) {
  Commissioned(RigFile(""));
  const RigParameters rig = ReadRig(RigFile(kEddyCurrents));
  const Scenario s = ReadScenarioText(
      "name = \"healthy\"\nrig = \"rig.toml\"\nduration = 0.02\nrecord_rate = 1000.0\nseed = 1\n"
      "[speed]\nprofile = [[0.0, 300.0]]\n",
      "healthy.toml", rig);
  const RunResult r = Simulate(rig, s, {});
  EXPECT_THAT(r.actions, IsEmpty());
  EXPECT_EQ(r.metrics.false_alarms, 0);
  EXPECT_THAT(r.notes, Contains(HasSubstr("learnt on another machine")));
}

}  // namespace
}  // namespace ambrig
