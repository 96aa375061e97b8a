/// The two sides of a rig file: what the drawing says, and what is simulated.
#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "rig/nominal_control.h"
#include "rig/rig_assembly.h"
#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

// Neither stands for the other, nor does a rig file's content without being named.
static_assert(!std::is_convertible_v<RigParameters, NominalRig>);
static_assert(!std::is_convertible_v<RigParameters, TrueRig>);
static_assert(!std::is_constructible_v<NominalRig, TrueRig>);
static_assert(!std::is_constructible_v<TrueRig, NominalRig>);
static_assert(!std::is_invocable_v<decltype(BuildPlant), NominalRig>);
static_assert(!std::is_invocable_v<decltype(BuildPlant), RigParameters>);
static_assert(!std::is_invocable_v<decltype(MakeBearingControl), TrueRig, std::size_t>);

double Other(double value) { return value == 0 ? 0.01 : 1.01 * value; }

TEST(NominalAndTrueRig, EveryParameterHasTwoValuesOnceItIsCalibrated) {
  const RigParameters drawn = ReferenceLanesRig();
  const std::vector<std::string> paths = ParameterPaths(drawn);
  EXPECT_GT(paths.size(), 60u);
  for (const std::string& path : paths) {
    const double value = *ParameterAt(drawn, path);
    if (std::isnan(value)) continue;  // not given, and not needed
    RigParameters rig = drawn;
    rig.tolerances.push_back({path, 0, Other(value)});
    const NominalRig nominal(rig);
    const TrueRig truth(rig);
    EXPECT_EQ(*ParameterAt(*nominal, path), value) << path;
    EXPECT_EQ(*ParameterAt(*truth, path), Other(value)) << path;
    EXPECT_EQ(*ParameterAt(*TrueRig::AsDrawn(nominal), path), value) << path;
    EXPECT_TRUE(HasCalibration(rig)) << path;
    EXPECT_FALSE(HasCalibration(*nominal)) << path;
    EXPECT_FALSE(HasCalibration(*truth)) << path;
  }
}

TEST(NominalAndTrueRig, ThePlantIsBuiltFromTheTrueValuesAndTheControlFromTheDrawn) {
  RigParameters rig = ReferenceLanesRig();
  rig.tolerances.push_back({"bearings.A.first_pole_angle_deg", 0, 30});
  rig.tolerances.push_back({"bearings.A.resistance", 0, 0.6});
  rig.tolerances.push_back({"amplifier.bus_voltage", 0, 28});
  const Plant plant = BuildPlant(TrueRig(rig));
  const double degree = std::acos(-1.0) / 180;
  EXPECT_NEAR(plant.bearings[0].lanes.direction_x[0], std::cos(30 * degree), 1e-12);
  EXPECT_EQ(plant.bearings[0].lanes.resistance[0], 0.6);
  EXPECT_EQ(plant.bus.voltage, 28);
  const NominalRig nominal(rig);
  const BearingControl control = MakeBearingControl(nominal, 0);
  EXPECT_NEAR(control.map.W(0, 1), std::cos(22.5 * degree), 1e-12);
  EXPECT_NEAR(control.map.W(0, 2), std::sin(22.5 * degree), 1e-12);
  // 1 V of mean voltage is 1/(2 U_d) of duty for the drawn bus.
  const CurrentRegulator& r = control.regulator[0];
  EXPECT_NEAR(r.DutyFromVoltage(1) - r.DutyFromVoltage(0), 1.0 / 60, 1e-15);
}

}  // namespace
}  // namespace ambrig
