// Mean voltage and edge of a bridge with errors, by hand and by differences.
#include "analysis/linear/bridge_point.h"

#include <gtest/gtest.h>

namespace ambrig {
namespace {

AmplifierParameters Amplifier(Modulation m) {
  AmplifierParameters p;
  p.modulation = m;
  p.bus_voltage = 100;
  p.switch_drop = 1;
  p.diode_drop = 0.7;
  p.switching_frequency = 25e3;
  return p;
}

BridgeImperfection Errors() {
  BridgeImperfection b;
  b.dead_time = 0.4e-6;
  b.voltage_offset = 0.8;
  b.freewheel_drop = 0.6;
  b.late_edge = 0.1e-6;
  return b;
}

// On from dead time to d T + late edge at U - 2 U_s, else -(U + 2 U_d), all with the offset.
TEST(BridgePoint, BiStateByHand) {
  const BridgePoint at = BridgeAt(Amplifier(Modulation::kBiState), Errors(), 100, 0.6);
  const double T = 40e-6, on = 0.6 * T + 0.1e-6 - 0.4e-6;
  EXPECT_NEAR(at.volts, (on * 98 - (T - on) * 101.4) / T + 0.8, 1e-9);
  EXPECT_NEAR(at.impulse, 199.4 * T, 1e-12);
  EXPECT_DOUBLE_EQ(at.edge, 0.6 * T + 0.1e-6);
}

class EveryBridge : public ::testing::TestWithParam<Modulation> {};

TEST_P(EveryBridge, ItsDutyHoldsTheVoltage) {
  const AmplifierParameters p = Amplifier(GetParam());
  for (const double volts : {0.9, 3.0, 40.0}) {
    const double duty = DutyForVoltage(p, Errors(), 100, volts, 0.5);
    EXPECT_NEAR(BridgeAt(p, Errors(), 100, duty).volts, volts, 1e-9) << volts;
    const double h = 1e-5;
    const double slope =
        (BridgeAt(p, Errors(), 100, duty + h).volts - BridgeAt(p, Errors(), 100, duty - h).volts) /
        (2 * h);
    const BridgePoint at = BridgeAt(p, Errors(), 100, duty);
    EXPECT_NEAR(at.whole ? at.impulse : at.impulse * p.switching_frequency, slope, 1e-6 * slope);
  }
}

INSTANTIATE_TEST_SUITE_P(Modulations, EveryBridge,
                         ::testing::Values(Modulation::kBiState, Modulation::kTriState,
                                           Modulation::kChopper, Modulation::kIdeal));

}  // namespace
}  // namespace ambrig
