// An ideal amplifier's duty has a sign: -0.5 on 24 V is -12 V, whatever the switching bridges do
// with a duty below their dead one.
#include <gtest/gtest.h>

#include "actuators/electronics/power_bridge.h"

namespace ambrig {
namespace {

AmplifierParameters Ideal() {
  AmplifierParameters p;
  p.bus_voltage = 24;
  p.switching_frequency = 20000;
  p.kp = p.ki = 1;
  p.i_max = 3;
  p.quadrants = 4;
  p.duty_min = -1;
  p.duty_max = 1;
  p.modulation = Modulation::kIdeal;
  return p;
}

double MeanVoltage(const AmplifierParameters& p, double duty, const BridgeImperfection& bridge) {
  const CoilVoltage v = PowerBridge(p).Pattern(duty, bridge);
  const double T = 1 / p.switching_frequency, part[3] = {v.t1, v.t2 - v.t1, T - v.t2};
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += part[k] * (v.gain[k] * p.bus_voltage + v.drop[k]);
  return sum / T;
}

TEST(IdealAmplifier, NegativeDutyIsANegativeVoltage) {
  const AmplifierParameters p = Ideal();
  for (const double duty : {-1.0, -0.5, -0.01, 0.0, 0.01, 0.5, 1.0})
    EXPECT_DOUBLE_EQ(MeanVoltage(p, duty, {}), 24 * duty);
}

TEST(IdealAmplifier, DeadDutyCountsToBothSides) {
  BridgeImperfection bridge;
  bridge.dead_duty = 0.1;
  const AmplifierParameters p = Ideal();
  EXPECT_DOUBLE_EQ(MeanVoltage(p, 0.05, bridge), 0);
  EXPECT_DOUBLE_EQ(MeanVoltage(p, -0.05, bridge), 0);
  EXPECT_DOUBLE_EQ(MeanVoltage(p, -0.2, bridge), -4.8);
}

}  // namespace
}  // namespace ambrig
