// Factors that bring a column back to the model: units of speed, of a level and of a movement; and
// hum, which is none.
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
using testing::RadialRig;
using testing::RecordNamed;
using testing::SamplesOf;

/// A column times each factor is named as one in another unit, and nothing else is. A factor of a
/// list is found as it is, any other one is fitted to this share.
void ExpectUnits(const char* record, const std::string& channel, const std::vector<double>& factors,
                 double share = 1e-6) {
  const Case sound = Measured({}, 0, record);
  for (const double factor : factors) {
    Case c = sound;
    for (double& v : SamplesOf(c, record, channel)) v *= factor;
    const auto faults = FaultsOf(c);
    ASSERT_EQ(faults.size(), 1U) << factor;
    EXPECT_EQ(faults[0].fault, "unit");
    EXPECT_EQ(faults[0].channel, channel);
    EXPECT_NEAR(faults[0].factor, factor, share * factor);
  }
}

// Of a speed column the prediction is the scenario's own profile.
TEST(GateFactors, ASpeedInAnotherUnitIsNamedWithItsFactor) {
  const char* kTurning = "multisine at 60 Hz";
  for (const double factor : {60 / (2 * M_PI), 1 / (2 * M_PI), 180 / M_PI, -1.0}) {
    Case c = Measured({}, 0, kTurning);
    for (double& v : SamplesOf(c, kTurning, "omega")) v *= factor;
    const auto faults = FaultsOf(c);
    ASSERT_EQ(faults.size(), 1U) << factor;
    EXPECT_EQ(faults[0].fault, factor < 0 ? "sign" : "unit");
    EXPECT_EQ(faults[0].record, kTurning);
    EXPECT_EQ(faults[0].channel, "omega");
    EXPECT_NEAR(faults[0].factor, factor, 1e-9);
    EXPECT_NE(faults[0].mend.find("channels.\"omega\""), std::string::npos);
  }
}

// A speed that no factor makes that of the scenario is of another one.
TEST(GateFactors, ASpeedThatWasNotCommandedIsOfAnotherScenario) {
  const char* kTurning = "multisine at 60 Hz";
  Case c = Measured({}, 0, kTurning);
  std::vector<double>& omega = SamplesOf(c, kTurning, "omega");
  for (std::size_t k = 0; k < omega.size(); ++k) omega[k] = 0.05 * static_cast<double>(k);
  const auto faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "scenario") << FaultText(faults[0]);
  EXPECT_EQ(faults[0].record, kTurning);
  EXPECT_EQ(faults[0].channel, "");
}

std::string RunUpOf(const RigParameters& rig) {
  for (const ExaminationRecord& r : Examination(rig, 4))
    if (r.title.starts_with("run-up")) return r.title;
  return "";
}

// A logger that stops reading the speed in a run-up has not run another scenario.
TEST(GateFactors, ASpeedThatStandsWhileItsProfileMovesIsFrozen) {
  const std::string run_up = RunUpOf(RadialRig());
  Case c = Measured({}, 0, run_up);
  std::vector<double>& omega = SamplesOf(c, run_up.c_str(), "omega");
  const std::size_t rows = omega.size() * 3 / 10;
  std::fill_n(omega.begin() + static_cast<std::ptrdiff_t>(rows), rows, omega[rows]);
  const auto faults = FaultsOf(c);
  ExpectOnly(faults, "freeze", "omega");
  EXPECT_NEAR(faults[0].seconds,
              static_cast<double>(rows) / c.records[RecordNamed(c, run_up)].data.rate, 2e-3);
}

// A clock keeps the profile's corners, the lag of a drive rounds them.
TEST(GateFactors, ASpeedThatComesLateIsNamedWithItsTimeAndTheLagOfADriveIsNot) {
  const std::string run_up = RunUpOf(RadialRig());
  for (const bool drive : {false, true}) {
    Case c = Measured({}, 0, run_up);
    const std::size_t record = RecordNamed(c, run_up);
    const double rate = c.records[record].data.rate;
    std::vector<double>& omega = SamplesOf(c, run_up.c_str(), "omega");
    const auto late = static_cast<std::ptrdiff_t>(std::lround(0.02 * rate));
    if (drive)
      for (std::size_t k = 1; k < omega.size(); ++k)
        omega[k] = omega[k - 1] + (omega[k] - omega[k - 1]) / (0.02 * rate);
    else
      std::copy_backward(omega.begin(), omega.end() - late, omega.end());
    const auto faults = FaultsOf(c);
    if (drive) {
      EXPECT_TRUE(faults.empty()) << FaultText(faults[0]);
      continue;
    }
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].fault, "lag");
    EXPECT_EQ(faults[0].record, run_up);
    EXPECT_NEAR(faults[0].seconds, 0.02, 1e-3);
  }
}

// The bus stands at its voltage: its noise has no correlation with a prediction, its level does.
TEST(GateFactors, AConstantColumnShowsItsFactorByItsLevel) {
  ExpectUnits(kStepRecord, "bus", {2.0, 0.5, std::sqrt(2.0), 25.4, 57.29577951308232});
}

// A load cell in kilograms or inches of a probe: the column moves as predicted, in another unit.
TEST(GateFactors, AMovingColumnShowsItsFactor) {
  ExpectUnits(kClampedRecord, "A.fx",
              {1e3, 1e-3, 180 / kPi, 9.81, 1 / 9.81, 25.4, 1 / 25.4, 2.0, 0.5});
}

// Factors that no list holds: an inch for a metre, a gain that was forgotten.
TEST(GateFactors, AMovingColumnShowsAnyFactorThatNoSensorHas) {
  ExpectUnits(kClampedRecord, "A.fx", {0.0254, 1 / 0.0254});
  ExpectUnits(kStepRecord, "A.x", {0.3, 3.3}, 0.05);
}

// Micrometres without a unit: the file rounds such numbers more coarsely than the shaft moves, and
// a prefix of a thousand leaves little as well.
TEST(GateFactors, APositionInAFarUnitShowsWhichOne) {
  ExpectUnits(kStepRecord, "A.x", {1e3, 1e4, 1e5, 1e6, 1e9});
  ExpectUnits("multisine at 60 Hz", "A.y", {1e3, 1e6});
}

TEST(GateFactors, AllPositionsInMicrometresAreNamedWithTheirUnit) {
  Case c = Measured();
  for (const char* axis : {"A.x", "A.y", "B.x", "B.y"})
    for (double& v : SamplesOf(c, kStepRecord, axis)) v *= 1e6;
  const auto faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 4U);
  for (const DataFault& f : faults) {
    EXPECT_NEAR(f.factor, 1e6, 1e-3);
    EXPECT_TRUE(f.mend.ends_with("unit = \"um\" }")) << f.mend;
  }
}

// A coil's bias with little movement, another one in each run: a coil that had such a current would
// move the others.
TEST(GateFactors, ALevelShowsAnyFactorThatNoSensorHas) {
  ExpectUnits(kStepRecord, "A.i2", {0.061, 4.07}, 0.02);
  ExpectUnits("multisine at 60 Hz", "A.i4", {0.3, 4.07}, 0.02);
  ExpectUnits(kStepRecord, "bus", {0.3, 4.07}, 0.02);
}

// A level has no movement that could be opposite: a clamped shaft, a coil's bias, the bus.
TEST(GateFactors, ALevelShowsItsSign) {
  const Case sound = Measured();
  for (const auto& [record, channel] :
       {std::pair{kStepRecord, "bus"}, {kStepRecord, "A.i2"}, {kClampedRecord, "A.i2"}}) {
    Case c = sound;
    for (double& v : SamplesOf(c, record, channel)) v = -v;
    ExpectOnly(FaultsOf(c), "sign", channel);
  }
}

// The zero of a sensor makes any factor of a position that is held.
TEST(GateFactors, AZeroOfAHeldSensorIsNoFactor) {
  const Case sound = Measured();
  for (const double factor : {0.5, std::sqrt(0.5), std::sqrt(2.0), 2.0, 1 / 25.4}) {
    Case c = sound;
    std::vector<double>& x = SamplesOf(c, kClampedRecord, "A.x");
    const double zero = (factor - 1) * x[0];
    for (double& v : x) v += zero;
    const auto faults = FaultsOf(c);
    EXPECT_TRUE(faults.empty()) << factor << ": " << FaultText(faults[0]);
  }
}

// Currents that are larger by the root of two make twice the force in both directions, and no other
// column of a held shaft shows it. One cell alone is wrong, and so are both with a factor that no
// machine makes.
TEST(GateFactors, ForcesOfBothDirectionsAreTheMachines) {
  const Case sound = Measured();
  const auto faults_of = [&](double fx, double fy) {
    Case c = sound;
    for (double& v : SamplesOf(c, kClampedRecord, "A.fx")) v *= fx;
    for (double& v : SamplesOf(c, kClampedRecord, "A.fy")) v *= fy;
    return FaultsOf(c).size();
  };
  EXPECT_EQ(faults_of(2, 2), 0U);
  EXPECT_EQ(faults_of(std::sqrt(0.5), std::sqrt(0.5)), 0U);
  EXPECT_EQ(faults_of(2, 1), 1U);
  EXPECT_EQ(faults_of(9.81, 9.81), 2U);
}

// A sensor that adds hum where the model expects nothing but noise: no factor of a thousand.
TEST(GateFactors, HumIsNoUnit) {
  Case c = Measured();
  std::vector<double>& z = SamplesOf(c, kClampedRecord, "B.y");
  const double level = z[0];
  for (std::size_t k = 0; k < z.size(); ++k)
    z[k] = z[k] - level + 9e-5 * std::sin(2 * 3.14159265 * 50 * static_cast<double>(k) / 12500.0);
  for (const DataFault& f : FaultsOf(c)) EXPECT_NE(f.fault, "unit") << FaultText(f);
}

}  // namespace
}  // namespace ambrig
