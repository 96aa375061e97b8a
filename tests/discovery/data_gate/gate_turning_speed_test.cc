// A record without a measured speed whose rotor turned otherwise than its profile says is told by
// its synchronous line; lines that do not turn with the speed are left to the effects.
#include <gmock/gmock.h>

#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::FaultsOf;
using testing::RadialRig;
using testing::RecordNamed;

constexpr const char* kSlowSines = "multisine at 60 Hz";
constexpr const char* kTurningSteps = "steps at 100 Hz";

EffectInstance UnbalanceAtA() {
  EffectInstance e = MakeInstance(EffectNamed("unbalance"), "A");
  e.Set("c", 2e-5);
  e.Set("s", -1e-5);
  return e;
}

/// Records at rest, at 377 rad/s and at 628 rad/s, none of which logs the speed. `turned` [rad/s]:
/// of the record that states 377.
Case TurnedAt(double turned, const EffectInstance& effect,
              const RigParameters& file = RadialRig()) {
  std::vector<ExaminationRecord> chosen;
  for (const ExaminationRecord& r : Examination(RadialRig(), 4))
    if (r.title == testing::kStepRecord || r.title == kSlowSines || r.title == kTurningSteps)
      chosen.push_back(r);
  Case c = EmptyCase(file, chosen);
  for (CaseRecord& r : c.records)
    testing::DropChannels(
        r, [](const std::string& name) { return name == "omega" || name == "theta"; });
  RigParameters truth = RadialRig();
  truth.effects = {effect};
  return testing::MeasuredUnder(
      c, RecordNamed(c, kSlowSines),
      [&](Scenario& s) {
        s.speed = SpeedProfile({{0.0, turned}, {s.duration, turned}});
      },
      truth);
}

void ExpectTold(const std::vector<DataFault>& faults, const std::string& speed) {
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "scenario") << FaultText(faults[0]);
  EXPECT_EQ(faults[0].record, kSlowSines);
  EXPECT_THAT(faults[0].detail, ::testing::HasSubstr("its rotor turned with " + speed));
}

TEST(GateTurningSpeed, AnotherSpeedThanTheProfiles) {
  ExpectTold(FaultsOf(TurnedAt(450, UnbalanceAtA())), "450");
}

// A motor that slips by 2 %.
TEST(GateTurningSpeed, ASlip) { ExpectTold(FaultsOf(TurnedAt(369.5, UnbalanceAtA())), "369"); }

TEST(GateTurningSpeed, TheRightSpeedIsNotAtFault) {
  EXPECT_TRUE(FaultsOf(TurnedAt(377, UnbalanceAtA())).empty());
}

TEST(GateTurningSpeed, AFloorThatShakesIsLeftToTheEffects) {
  EffectInstance floor = MakeInstance(EffectNamed("base-vibration"), "rig");
  floor.Set("frequency", 72);
  floor.Set("cx", 1);
  floor.Set("sy", 1);
  EXPECT_TRUE(FaultsOf(TurnedAt(377, floor)).empty());
}

// The rig file knows its unbalance: one record at speed is enough.
TEST(GateTurningSpeed, ALineThatTheRigFileExpectsElsewhere) {
  RigParameters file = RadialRig();
  file.effects = {UnbalanceAtA()};
  Case c = TurnedAt(450, UnbalanceAtA(), file);
  std::erase_if(c.records, [](const CaseRecord& r) { return r.data_file == kTurningSteps; });
  ExpectTold(FaultsOf(c), "450");
}

}  // namespace
}  // namespace ambrig
