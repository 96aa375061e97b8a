/// The bridge: voltages of a period for every modulation, faults, and its ideal model.
#include "actuators/electronics/power_bridge.h"

#include <gtest/gtest.h>

#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

AmplifierParameters Reference(Modulation m = Modulation::kBiState) {
  AmplifierParameters p = ReferenceLanesRig().amplifier;
  p.modulation = m;
  return p;
}

/// Mean voltage of a period at the nominal bus. [V]
double Mean(const CoilVoltage& v, double bus, double T) {
  const double edge[4] = {0, v.t1, std::max(v.t1, v.t2), T};
  double sum = 0;
  for (int q = 0; q < 3; ++q) sum += (v.gain[q] * bus + v.drop[q]) * (edge[q + 1] - edge[q]);
  return sum / T;
}

// base_model.md section 3: on +U_d - 2 U_s for d T, off -(U_d + 2 U_c); the other bridges likewise.
TEST(PowerBridge, MeanVoltageOfEveryModulation) {
  const double T = 40e-6, U = 30, Us = 0.125, Uc = 0.70;
  for (double d : {0.1, 0.5, 0.73, 0.98}) {
    const auto mean = [&](Modulation m) {
      const AmplifierParameters p = Reference(m);
      return Mean(PowerBridge(p).Pattern(d, {}), U, T);
    };
    EXPECT_NEAR(mean(Modulation::kBiState), d * (U - 2 * Us) - (1 - d) * (U + 2 * Uc), 1e-12) << d;
    const double drive = 2 * d - 1;
    const double driven = drive > 0 ? drive * (U - 2 * Us) : drive * (U + 2 * Uc);
    EXPECT_NEAR(mean(Modulation::kTriState), driven - (1 - std::abs(drive)) * (Us + Uc), 1e-12)
        << d;
    EXPECT_NEAR(mean(Modulation::kChopper), d * U, 1e-12) << d;
    EXPECT_NEAR(mean(Modulation::kIdeal), d * U, 1e-12) << d;
  }
}

TEST(PowerBridge, FourQuadrantsSwingBothWays) {
  AmplifierParameters p = Reference();
  p.quadrants = 4;
  EXPECT_NEAR(Mean(PowerBridge(p).Pattern(0.5, {}), 30, 40e-6), 0, 1e-12);
}

TEST(PowerBridge, FaultsOfTheBridge) {
  const AmplifierParameters p = Reference();
  const PowerBridge a(p);
  BridgeImperfection bridge;
  bridge.off = true;
  EXPECT_NEAR(Mean(a.Pattern(0.7, bridge), 30, 40e-6), -31.4, 1e-12);
  bridge = {};
  bridge.stuck_on = true;
  EXPECT_NEAR(Mean(a.Pattern(0.02, bridge), 30, 40e-6), 29.75, 1e-12);
  bridge = {};
  bridge.dead_time = 1e-6;  // the on phase starts 1 us late
  EXPECT_NEAR(Mean(a.Pattern(0.5, bridge), 30, 40e-6), Mean(a.Pattern(0.475, {}), 30, 40e-6),
              1e-12);
}

// What detectors and designers compute with is the bridge without imperfections, bit by bit.
TEST(PowerBridge, IdealOneIsTheSameForEveryModulation) {
  for (Modulation m :
       {Modulation::kBiState, Modulation::kTriState, Modulation::kChopper, Modulation::kIdeal})
    for (double d : {0.02, 0.3, 0.5, 0.98}) {
      const CoilVoltage a = IdealBridgeVoltage(Reference(m), d),
                        b = PowerBridge(Reference(m)).Pattern(d, {});
      EXPECT_EQ(a.t1, b.t1);
      EXPECT_EQ(a.t2, b.t2);
      for (int q = 0; q < 3; ++q) {
        EXPECT_EQ(a.gain[q], b.gain[q]);
        EXPECT_EQ(a.drop[q], b.drop[q]);
      }
    }
}

}  // namespace
}  // namespace ambrig
