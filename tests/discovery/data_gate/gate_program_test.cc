// The gains of the controller that ran against those of the rig file.
#include <gmock/gmock.h>

#include <fmt/format.h>

#include "discovery/data_gate/gate_checks.h"
#include "effects/catalogue.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using testing::Measured;

std::vector<DataFault> ProgramFaults(const Case& c) {
  std::vector<DataFault> out;
  CheckProgram(CaseModel(c), out);
  return out;
}

TEST(GateProgram, TellsTheGainsThatRan) {
  Case c = Measured({}, 0, "multisine at 60 Hz");
  const PidParameters ran = c.rig.controller.pid;
  c.rig.controller.pid.kp /= 1.07;
  c.rig.controller.pid.kd /= 1.1;
  const std::vector<DataFault> faults = ProgramFaults(c);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "controller");
  EXPECT_EQ(faults[0].record, c.rig_file);
  EXPECT_EQ(faults[0].mend,
            fmt::format("kp = {:.4g}, kd = {:.4g} in [controller]", ran.kp, ran.kd));
  EXPECT_THAT(FaultText(faults[0]), HasSubstr("had another controller than the file states"));
}

// An effect of the plant changes no set-point that does not follow from the readings.
TEST(GateProgram, IsSilentWhateverThePlantDoes) {
  EffectInstance strong = MakeInstance(EffectNamed("sensor-gain"), "A.x");
  strong.values[0] = 1.2;
  EXPECT_TRUE(ProgramFaults(Measured({strong})).empty());
}

// Another derivative filter is no matter of the gains: nothing is told that would not mend it.
TEST(GateProgram, TellsNoGainsThatLeaveTheError) {
  Case c = Measured({}, 0, "multisine at 60 Hz");
  c.rig.controller.pid.derivative_time_constant *= 4;
  EXPECT_TRUE(ProgramFaults(c).empty());
}

}  // namespace
}  // namespace ambrig
