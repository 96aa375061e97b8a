// Columns that a scenario commands and no model predicts: set-points of a held rotor, the angle of
// a prescribed speed.
#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::ExpectOnly;
using testing::FaultsOf;
using testing::kClampedRecord;
using testing::kStepRecord;
using testing::Measured;
using testing::RecordNamed;
using testing::SamplesOf;

constexpr const char* kRotorTurns = "multisine at 60 Hz";

TEST(GateCommands, SetPointsOfAHeldRotor) {
  const Case sound = Measured();
  for (const double factor : {1e3, -1.0}) {
    Case c = sound;
    for (double& v : SamplesOf(c, kClampedRecord, "A.s3")) v *= factor;
    const auto faults = FaultsOf(c);
    ExpectOnly(faults, factor < 0 ? "sign" : "unit", "A.s3");
    EXPECT_DOUBLE_EQ(faults[0].factor, factor);
  }
  Case c = sound;
  std::swap(SamplesOf(c, kClampedRecord, "A.s2"), SamplesOf(c, kClampedRecord, "B.s7"));
  ExpectOnly(FaultsOf(c), "swap", "A.s2");
}

// Commands that were larger than the scenario says are what the amplifiers did: the currents show
// them, too.
TEST(GateCommands, ACommandThatTheCurrentFollowsIsNoMistakeOfTheLogger) {
  Case c = Measured();
  for (const char* channel : {"A.s3", "A.i3"})
    for (double& v : SamplesOf(c, kClampedRecord, channel)) v *= 2;
  for (const DataFault& f : FaultsOf(c)) EXPECT_NE(f.channel, "A.s3") << FaultText(f);
}

// Measured positions that drive a record are predicted by nothing: millimetres read as metres lie
// outside the machine.
TEST(GateCommands, DrivesOfARecordThatCannotBe) {
  for (const bool wrong : {false, true}) {
    Case c = Measured();
    c.records[RecordNamed(c, kStepRecord)].imposed = Imposed::kMotion;
    std::vector<double>& x = SamplesOf(c, kStepRecord, "A.x");
    for (double& v : x) v = wrong ? 1e3 * (v + 2e-5) : v + 2e-5;
    const auto faults = FaultsOf(c);
    if (!wrong) {
      EXPECT_TRUE(faults.empty()) << FaultText(faults[0]);
      continue;
    }
    ASSERT_FALSE(faults.empty());
    EXPECT_EQ(faults[0].channel, "A.x");
    EXPECT_EQ(faults[0].fault, "unit");
    EXPECT_DOUBLE_EQ(faults[0].factor, 1e3);
  }
}

TEST(GateCommands, TheAngleOfAPrescribedSpeed) {
  const Case sound = Measured({}, 0, kRotorTurns);
  for (const double factor : {180 / kPi, 1 / kTurn, -1.0}) {
    Case c = sound;
    for (double& v : SamplesOf(c, kRotorTurns, "theta")) v = factor * v + 0.7;
    const auto faults = FaultsOf(c);
    ExpectOnly(faults, factor < 0 ? "sign" : "unit", "theta");
    EXPECT_DOUBLE_EQ(faults[0].factor, factor);
  }
}

// An encoder that starts again after every turn counts as it should, in degrees it does not.
TEST(GateCommands, AnAngleThatStartsAgainAfterEveryTurn) {
  for (const double turn : {kTurn, 360.0}) {
    Case c = Measured({}, 0, kRotorTurns);
    for (double& v : SamplesOf(c, kRotorTurns, "theta")) v = std::fmod(v * turn / kTurn, turn);
    const auto faults = FaultsOf(c);
    if (turn == kTurn)
      EXPECT_TRUE(faults.empty()) << FaultText(faults[0]);
    else
      ExpectOnly(faults, "unit", "theta");
  }
}

}  // namespace
}  // namespace ambrig
