// Loads that acted otherwise than their scenario states are told with what acted; what the rig does
// under its loads is left to the fits.
#include <gmock/gmock.h>

#include <functional>
#include <utility>

#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::FaultsOf;
using testing::kStepRecord;
using testing::Measured;
using testing::RadialRig;
using testing::RecordNamed;

/// The case whose step record was loaded otherwise than its scenario file says, on a rotor that is
/// 1 % heavier.
Case LoadedOtherwise(const std::function<void(LoadSpec&)>& change) {
  const Case c = Measured({}, 0, "multisine at 60 Hz");
  RigParameters heavier = RadialRig();
  heavier.rotor.mass *= 1.01;
  return testing::MeasuredUnder(
      c, RecordNamed(c, kStepRecord), [&](Scenario& scenario) { change(scenario.loads.at(0)); },
      heavier);
}

void ExpectLoad(const Case& c, const std::string& force_and_edges) {
  const std::vector<DataFault> faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "scenario") << FaultText(faults[0]);
  EXPECT_EQ(faults[0].record, kStepRecord);
  EXPECT_NE(faults[0].detail.find(force_and_edges), std::string::npos) << faults[0].detail;
}

TEST(GateInputs, AnotherDirection) {
  ExpectLoad(LoadedOtherwise([](LoadSpec& l) { std::swap(l.fx, l.fy); }),
             "its loads were rather force = [");
}

TEST(GateInputs, AnotherInstant) {
  ExpectLoad(LoadedOtherwise([](LoadSpec& l) { l.start -= 0.02; }), "start = 0.155, stop = 0.234");
}

TEST(GateInputs, AnotherSizeIsLeftToTheFits) {
  for (const double size : {0.5, 0.7, 1.3})
    for (const DataFault& f :
         FaultsOf(LoadedOtherwise([&](LoadSpec& l) { l.fx *= size, l.fy *= size; })))
      ADD_FAILURE() << size << ": " << FaultText(f);
}

// Without set-points the controller's program tells nothing of the commands.
TEST(GateInputs, ACommandOfAnotherSize) {
  const char* kSines = "multisine at 60 Hz";
  Case c = Measured({}, 0, kSines);
  CaseRecord& r = c.records[RecordNamed(c, kSines)];
  testing::DropChannels(r, [](const std::string& name) {
    return name.starts_with("A.s") || name.starts_with("B.s");
  });
  const std::string target = r.scenario.excitations.back().target;
  c = testing::MeasuredUnder(c, RecordNamed(c, kSines), [](Scenario& scenario) {
    scenario.excitations.back().amplitude *= 0.5;
  });
  const std::vector<DataFault> faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "scenario") << FaultText(faults[0]);
  EXPECT_THAT(faults[0].detail, ::testing::HasSubstr(target + " was 0."));
}

// A sideways answer to a load is that of the rig.
TEST(GateInputs, ARigWithCrossCouplingIsLoadedAsStated) {
  for (const DataFault& f :
       FaultsOf(Measured({testing::CrossCouplingAtA(1e5)}, 0, "multisine at 60 Hz")))
    ADD_FAILURE() << FaultText(f);
}

}  // namespace
}  // namespace ambrig
