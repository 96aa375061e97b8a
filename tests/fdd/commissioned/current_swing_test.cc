// Coils that have lost most of their turns: the current runs through its range in a few samples.
#include "fdd/commissioned/current_swing.h"

#include <gtest/gtest.h>

#include "tests/fdd/commissioned_plant.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_plant;

TEST(CurrentSwing, ShortsOfMostOfAWindingNameItsCoilAlone) {
  for (const char* share : {"0.8", "0.9"}) {
    const auto seen = Concluded(
        SlowIron().rig, &SlowIron().bearing,
        Operation(FaultOf(3, "partial-short", std::string("fraction = ") + share), 0.034));
    ASSERT_FALSE(seen->found.empty()) << share;
    EXPECT_EQ(seen->Coils(), std::set<int>{3}) << share;
    EXPECT_EQ(seen->found[0].cls, FaultClass::kPartialShort) << share;
    EXPECT_GT(seen->found[0].fraction, 0.65) << share;
    EXPECT_LT(seen->found[0].time - kOnset, 0.5e-3) << share;
  }
}

/// Readings of all coils at 1 A, with what `add` adds to those of coil 3 in every period.
class Readings {
 public:
  explicit Readings(double step_in_range) : step_(step_in_range) {
    sampling_.samples = 18;
    sampling_.amplifier = &bridge_;
    sampling_.step = 1 / (bridge_.switching_frequency * sampling_.samples);
    for (double& v : share_.v) v = 1;
  }
  CurrentSwing Make() const {
    return {MakeLinkageModel(testing_bench::Reference()), sampling_, 0.004};
  }
  int Period(CurrentSwing& swing, bool steps) {
    Lane step, reading, duty;
    for (double& v : reading.v) v = 1;
    if (steps) {
      step[2] = step_;
      reading[2] += step_;
    }
    MeasuredPeriod in;
    in.duty = &duty;
    in.bus = bridge_.bus_voltage;
    return swing.Period(in, step, reading, share_);
  }

 private:
  double step_;
  AmplifierParameters bridge_ = testing_bench::Bridge();
  SamplingSettings sampling_;
  Lane share_;
};

// A reading that steps once is that of a sensor, or of a current that has vanished.
TEST(CurrentSwing, OneStepIsNone) {
  Readings readings(3);
  CurrentSwing swing = readings.Make();
  for (int k = 0; k < 10; ++k) EXPECT_EQ(readings.Period(swing, false), -1);
  for (int k = 1; k < 6; ++k) {
    EXPECT_EQ(readings.Period(swing, true), -1);
    EXPECT_EQ(swing.unsettled(), k >= 4) << k;
  }
  EXPECT_EQ(readings.Period(swing, true), 2);
}

TEST(CurrentSwing, StepsThatTheLeakageAllowsAreNone) {
  const LinkageModel m = MakeLinkageModel(testing_bench::Reference());
  const AmplifierParameters bridge = testing_bench::Bridge();
  Readings readings(1.5 * bridge.bus_voltage / (bridge.switching_frequency * 18 * m.leakage[2]));
  CurrentSwing swing = readings.Make();
  for (int k = 0; k < 10; ++k) EXPECT_EQ(readings.Period(swing, true), -1);
  EXPECT_FALSE(swing.unsettled());
}

}  // namespace
}  // namespace ambrig
