// The controller's program as a witness: commands that are not the scenario's, readings and
// commands that come late.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_columns.h"
#include "effects/catalogue.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::kStepRecord;
using testing::Measured;
using testing::RadialRig;
using testing::RecordNamed;

/// Faults that the controller's program alone shows in the step record.
std::vector<DataFault> ControllerFaults(const Case& c) {
  std::vector<DataFault> out;
  CheckController(CaseModel(c), RecordNamed(c, kStepRecord), {}, out);
  return out;
}

/// The case whose step record was commanded otherwise than its scenario file says.
Case CommandedOtherwise(const std::function<void(Excitation&)>& change) {
  const Case c = Measured({}, 0, "multisine at 60 Hz");
  return testing::MeasuredUnder(c, RecordNamed(c, kStepRecord), [&](Scenario& scenario) {
    for (Excitation& e : scenario.excitations) change(e);
  });
}

void ShiftColumn(Case& c, const std::string& channel, std::size_t rows) {
  std::vector<double>& y = testing::SamplesOf(c, kStepRecord, channel);
  for (std::size_t k = y.size(); k-- > 0;) y[k] = y[k > rows ? k - rows : 0];
}

TEST(GateController, AgreesWithItsOwnRecordWhateverThePlantDoes) {
  const EffectInstance gain = MakeInstance(EffectNamed("sensor-gain"), "A.x");
  EffectInstance strong = gain;
  strong.values[0] = 1.2;
  EXPECT_TRUE(ControllerFaults(Measured({strong})).empty());
}

TEST(GateController, CommandsOfAnotherAxisAreOfAnotherScenario) {
  const Case c = CommandedOtherwise([](Excitation& e) {
    if (e.target == "A.x") e.target = "B.y";
  });
  const std::vector<DataFault> faults = ControllerFaults(c);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "scenario");
  EXPECT_EQ(faults[0].channel, "");
  EXPECT_NE(faults[0].detail.find("commanded otherwise at"), std::string::npos);
  EXPECT_NE(FaultText(faults[0]).find(faults[0].detail), std::string::npos);
}

TEST(GateController, CommandsOfAnotherSizeAreOfAnotherScenarioBeyondWhatFitsAllow) {
  const auto sized = [](double gain) {
    return ControllerFaults(CommandedOtherwise([&](Excitation& e) { e.amplitude *= gain; }));
  };
  for (const DataFault& f : sized(1.1)) ADD_FAILURE() << FaultText(f);
  for (const double gain : {2.5, -1.0}) {
    const std::vector<DataFault> faults = sized(gain);
    ASSERT_EQ(faults.size(), 1U) << gain;
    EXPECT_EQ(faults[0].fault, "scenario");
  }
}

// One sine of four had another size: its high frequencies look like the noise of a sensor.
TEST(GateController, ACommandOfAnotherSizeIsNamed) {
  Case c = Measured({}, 0, "multisine at 60 Hz");
  const std::size_t record = RecordNamed(c, "multisine at 60 Hz");
  c = testing::MeasuredUnder(
      c, record, [](Scenario& scenario) { scenario.excitations.back().amplitude *= 0.625; });
  std::vector<DataFault> faults;
  CheckController(CaseModel(c), record, {}, faults);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "scenario");
  EXPECT_EQ(faults[0].detail, "its multisine at " +
                                  c.records[record].scenario.excitations.back().target +
                                  " was 0.625 times what the scenario says");
}

TEST(GateController, CommandsThatAreLateAreTheClockOfTheRecord) {
  const auto late = [](double rows) {
    return ControllerFaults(CommandedOtherwise([&](Excitation& e) {
      e.start += rows / RadialRig().controller.rate;
      e.stop += rows / RadialRig().controller.rate;
    }));
  };
  for (const DataFault& f : late(2.4)) ADD_FAILURE() << FaultText(f);  // the fits give as much
  const std::vector<DataFault> faults = late(80);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "lag");
  EXPECT_EQ(faults[0].channel, "");
  EXPECT_NEAR(faults[0].seconds, 80 / RadialRig().controller.rate, 1e-5);
}

/// The case without rows `first` to `first` + `rows` of one record.
void LoseRows(Case& c, const std::string& record, long first, long rows) {
  CaseRecord& r = c.records[RecordNamed(c, record)];
  for (Channel& ch : r.data.channels)
    ch.samples.erase(ch.samples.begin() + first, ch.samples.begin() + first + rows);
}

// Blocks that are too short for the prediction to tell, on a machine with a force that the model
// lacks.
TEST(GateController, LostRowsAreToldByTheCommands) {
  const char* kSines = "multisine at 60 Hz";
  Case c = Measured({testing::CrossCouplingAtA(1e5)}, 0, kSines);
  const std::size_t record = RecordNamed(c, kSines);
  LoseRows(c, kSines, 2000, 9);
  LoseRows(c, kSines, 900, 5);
  std::vector<DataFault> faults;
  CheckController(CaseModel(c), record, {}, faults);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "lost");
  EXPECT_NEAR(faults[0].seconds, 5 / c.records[record].data.rate, 1e-9);
  EXPECT_NE(faults[0].detail.find("5 rows at "), std::string::npos) << faults[0].detail;
  EXPECT_NE(faults[0].detail.find(", 9 rows at "), std::string::npos) << faults[0].detail;
}

TEST(GateController, AReadingThatIsLateByFewRowsIsNamed) {
  Case c = Measured();
  ShiftColumn(c, "A.x", 5);
  const std::vector<DataFault> faults = ControllerFaults(c);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "lag");
  EXPECT_EQ(faults[0].channel, "A.x");
  EXPECT_NEAR(faults[0].seconds, 5 / RadialRig().controller.rate, 1e-9);
}

// No factor of a list of units, and none that the sensor could have: the controller would have seen
// that.
TEST(GateController, AReadingThatWasLoggedWithAnotherGainIsNamed) {
  Case c = Measured();
  for (double& y : testing::SamplesOf(c, kStepRecord, "A.x")) y /= std::sqrt(2.0);
  const std::vector<DataFault> faults = ControllerFaults(c);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "unit");
  EXPECT_EQ(faults[0].channel, "A.x");
  EXPECT_NEAR(faults[0].factor, std::sqrt(0.5), 1e-3);
}

// A controller that is another one than the rig file's disagrees with every axis of every record.
TEST(GateController, AnotherControllerIsNoFaultOfTheData) {
  Case c = Measured({}, 0, "multisine at 60 Hz");
  c.rig.controller.pid.kp *= 1.4;
  EXPECT_TRUE(ControllerFaults(c).empty());
}

}  // namespace
}  // namespace ambrig
