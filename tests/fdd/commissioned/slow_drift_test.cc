// Slow drift is followed within bounds; a fault is not, however slowly it grows. Plants: the
// switching engine with eddy currents, fringing, copper that warms and sensors whose zeros wander.
#include "fdd/commissioned/slow_drift.h"

#include <gtest/gtest.h>

#include "core/base/read_file.h"
#include "tests/fdd/commissioned_plant.h"

namespace ambrig {
namespace {

using namespace testing_plant;

Lane Everywhere(double v) {
  Lane lane;
  for (double& one : lane.v) one = v;
  return lane;
}

/// `c` seen for `seconds`, all of it common or all of it one coil's own.
void Follow(SlowDrift& drift, const Lane& c, bool common, double seconds) {
  constexpr double kStep = 1.6e-3;  // [s]
  for (long k = std::lround(seconds / kStep); k > 0; --k) {
    Lane left;
    for (int j = 0; j < kLanes; ++j) left[j] = c[j] - drift.expected()[j];
    drift.Follow(left, common ? left : Lane{}, kStep);
  }
}

TEST(SlowDrift, ComesUpWithItsTimeConstantAndIsTakenOff) {
  SlowDrift drift;
  Follow(drift, Everywhere(0.05), true, SlowDrift::kTimeConstant);
  // 125 steps of 1/125 of what is left: 1 - (1 - 1/125)^125.
  EXPECT_NEAR(drift.expected()[3], 0.05 * (1 - std::pow(1 - 1 / 125.0, 125)), 1e-9);
  SlopeExcess period;
  period.bottom[0] = Everywhere(10);
  period.bottom[1] = Everywhere(20);
  drift.TakeOff(&period);
  for (int q = 0; q < 2; ++q)
    EXPECT_NEAR(period.top[q][3] / period.bottom[q][3], -drift.expected()[3], 1e-15);
}

TEST(SlowDrift, HasBounds) {
  SlowDrift common, own;
  Follow(common, Everywhere(0.3), true, 20);
  EXPECT_NEAR(common.expected()[0], SlowDrift::kMostCommon, 1e-12);
  Lane one;
  one[4] = -0.3;
  Follow(own, one, false, 20);
  EXPECT_EQ(own.expected()[4], -SlowDrift::kMostOwn);
  EXPECT_EQ(own.expected()[3], 0);
}

/// Hovering; faults are added.
std::string Hover(double duration, const std::string& faults) {
  return fmt::format(R"(name = "hover"
rig = "rig.toml"
duration = {}
record_rate = 1000.0
seed = 3
[start]
state = "levitated"
[speed]
profile = [[0.0, 157.0]]
)",
                     duration) +
         faults;
}

/// SlowIron's machine later: its copper warms by some 60 K, the zeros of A wander by `metres` in
/// 0.6 s.
RigParameters Later(double metres) {
  RigParameters rig = WithEffect(SlowIron().rig, "copper-heating", "A",
                                 {{"rise_per_watt", 30}, {"time_constant", 0.1}});
  const RigParameters drifting = ReadRigText(
      ReadFile(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml") +
          fmt::format("\n[[effect]]\nname = \"formula\"\ntarget = \"A\"\n"
                      "reading = {{ x = \"x + {0} * min(t, 0.6) / 0.6\", y = \"y - {0} * min(t, "
                      "0.6) / 0.6\" }}\n",
                      metres),
      "reference.toml");
  rig.effects.push_back(drifting.effects.back());
  return rig;
}

std::string ShortOf(int coil, double fraction, double t) {
  return FaultOf(coil, "partial-short", fmt::format("fraction = {}", fraction), t);
}

TEST(SlowDrift, RaisesNoAlarmAndHidesNoFaultAfterIt) {
  constexpr double kFault = 0.7000123;  // [s]
  for (const double metres : {1e-5, -1e-5}) {
    const RigParameters rig = Later(metres);
    for (const int coil : {2, 6}) {
      const auto seen =
          Concluded(rig, &SlowIron().bearing, Hover(0.72, ShortOf(coil, 0.1, kFault)));
      ASSERT_EQ(seen->Coils(), std::set<int>{coil}) << metres;
      EXPECT_GT(seen->found[0].time, kFault);
      EXPECT_LT(seen->found[0].time - kFault, 0.5e-3) << metres << " coil " << coil;
      EXPECT_EQ(seen->found[0].cls, FaultClass::kPartialShort);
    }
  }
}

/// Saturated iron, the zeros of whose sensors have moved since its commissioning.
RigParameters Moved(const CommissionedRig& iron, double x, double y) {
  const RigParameters rig = WithEffect(iron.rig, "sensor-offset", "A.x", {{"offset", x}});
  return WithEffect(rig, "sensor-offset", "A.y", {{"offset", y}});
}
constexpr double kMoved[] = {1e-5, 0, -1e-5};  // [m]

// The machine stood still while the zeros moved. Coils with saturated iron show that in no common
// pattern, by as much as shorts of 2 to 3 %.
TEST(SlowDrift, WhatHasDriftedBeforeTheStartIsNoFault) {
  const CommissionedRig iron(WithEffect(ReferenceRig(), "saturation", "A", {{"knee", 0.45}}));
  for (const double x : kMoved)
    for (const double y : kMoved)
      EXPECT_TRUE(Concluded(Moved(iron, x, y), &iron.bearing, Operation("", 0.05))->found.empty())
          << x << " " << y;
}

TEST(SlowDrift, WhatHasDriftedBeforeTheStartHidesNoFault) {
  const CommissionedRig iron(WithEffect(ReferenceRig(), "saturation", "A", {{"knee", 0.65}}));
  for (const double x : kMoved)
    for (const double y : kMoved) {
      const RigParameters rig = Moved(iron, x, y);
      const auto seen = Concluded(rig, &iron.bearing, Operation(ShortOf(3, 0.1, kOnset), 0.05));
      ASSERT_EQ(seen->Coils(), std::set<int>{3}) << x << " " << y;
      EXPECT_LT(seen->found[0].time - kOnset, 0.5e-3) << x << " " << y;
      // 7 % were shorted already when the machine started
      const auto early = Concluded(rig, &iron.bearing, Operation(ShortOf(6, 0.07, 1e-6), 0.03));
      EXPECT_EQ(early->Coils(), std::set<int>{6}) << x << " " << y;
    }
}

// Half a percent of the turns more every 20 ms: no faster than drift, and no drift.
TEST(SlowDrift, AShortThatGrowsSlowlyIsNotLearntAway) {
  for (const int coil : {3, 6}) {
    std::string faults;
    double left = 1;
    for (int k = 0; k < 20; ++k) {
      const double next = 1 - 0.005 * (k + 1);
      faults += ShortOf(coil, 1 - next / left, 0.1 + 0.02 * k);  // of the remaining turns
      left = next;
    }
    const auto seen = Concluded(SlowIron().rig, &SlowIron().bearing, Hover(0.52, faults));
    ASSERT_EQ(seen->Coils(), std::set<int>{coil});
    const Diagnosis& d = seen->found[0];
    const double share = 0.005 * (1 + std::floor((d.time - 0.1) / 0.02));
    EXPECT_LT(share, 0.07) << coil;
    EXPECT_EQ(d.cls, FaultClass::kPartialShort);
  }
}

}  // namespace
}  // namespace ambrig
