/// The power amplifier: voltages of a period, exact discrete current loop, anti-windup, standing
/// start.
#include "actuators/electronics/amplifier.h"

#include <gtest/gtest.h>

#include "actuators/electronics/adc.h"
#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

AmplifierParameters Reference(Modulation m = Modulation::kBiState) {
  AmplifierParameters p = ReferenceRig().amplifier;
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
TEST(Amplifier, MeanVoltageOfEveryModulation) {
  const double T = 40e-6, U = 30, Us = 0.125, Uc = 0.70;
  for (double d : {0.1, 0.5, 0.73, 0.98}) {
    const auto mean = [&](Modulation m) {
      const AmplifierParameters p = Reference(m);
      return Mean(PowerAmplifier(p).Pattern(d, {}), U, T);
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

TEST(Amplifier, FourQuadrantsSwingBothWays) {
  AmplifierParameters p = Reference();
  p.quadrants = 4;
  EXPECT_NEAR(Mean(PowerAmplifier(p).Pattern(0.5, {}), 30, 40e-6), 0, 1e-12);
}

// u_n = kp e_n + Σ_(m<=n) ki T e_m, d = 0.5 + u/(2 U_d): the increment of this period included.
TEST(Amplifier, CurrentLoopIsTheDiscretePi) {
  const AmplifierParameters p = Reference();
  PowerAmplifier a(p);
  a.set_integral(0.4);
  double integral = 0.4;
  for (int n = 0; n < 40; ++n) {
    const double e = 0.5 * std::sin(0.3 * n);
    integral += 2000 * 40e-6 * e;
    EXPECT_NEAR(a.CurrentLoop(2 + e, 2), 0.5 + (4 * e + integral) / 60, 1e-14) << n;
  }
}

// Beyond a limit on the side that e pushes to, the increment is dropped; on the other side it
// counts.
TEST(Amplifier, IntegralStandsStillAtTheLimit) {
  const AmplifierParameters p = Reference();
  PowerAmplifier a(p);
  a.set_integral(27);
  for (int n = 0; n < 5; ++n) EXPECT_EQ(a.CurrentLoop(5, 0), 0.98);
  EXPECT_EQ(a.integral(), 27);
  EXPECT_NEAR(a.CurrentLoop(0, 0.1), 0.5 + (-0.4 + 27 - 0.008) / 60, 1e-14);
  EXPECT_NEAR(a.integral(), 27 - 0.008, 1e-14);
  // The tentative duty is beyond the limit only through its increment: dropped, not clamped.
  a.set_integral(28.7596);
  EXPECT_NEAR(a.CurrentLoop(0.01, 0), 0.5 + (0.04 + 28.7596) / 60, 1e-14);
  a.set_integral(-30);
  EXPECT_EQ(a.CurrentLoop(0, 1), 0.02);
  EXPECT_EQ(a.integral(), -30);
}

// A standing start: with no error the duty's mean voltage is R i, for every modulation.
TEST(Amplifier, HoldCurrentStandsStill) {
  for (Modulation m :
       {Modulation::kBiState, Modulation::kTriState, Modulation::kChopper, Modulation::kIdeal})
    for (double quadrants : {2.0, 4.0}) {
      AmplifierParameters p = Reference(m);
      p.quadrants = quadrants;
      PowerAmplifier a(p);
      a.HoldCurrent(3, 0.5);
      EXPECT_NEAR(Mean(a.Pattern(a.CurrentLoop(3, 3), {}), 30, 40e-6), 1.5, 1e-12)
          << static_cast<int>(m) << quadrants;
    }
}

TEST(Amplifier, ACoilToldNoCurrentStartsAtTheLowerLimit) {
  const AmplifierParameters p = Reference();
  PowerAmplifier a(p);
  a.HoldCurrent(0.2, 0.5);
  EXPECT_NEAR(a.integral(), 60 * (0.02 - 0.5), 1e-12);
  EXPECT_NEAR(a.CurrentLoop(0, 0), 0.02, 1e-15);
}

TEST(Amplifier, FaultsOfTheBridge) {
  const AmplifierParameters p = Reference();
  const PowerAmplifier a(p);
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

// Signed, 12 bits over ±10 A: 4.88 mA a step, nearest code, clipped.
TEST(Adc, QuantiserRoundsAndClips) {
  const Quantiser q(12, 10);
  const double lsb = 20.0 / 4096;
  EXPECT_EQ(q(0.4999 * lsb), 0);
  EXPECT_EQ(q(0.5001 * lsb), lsb);
  EXPECT_EQ(q(-0.5001 * lsb), -lsb);
  EXPECT_EQ(q(1e3), 10 - lsb);
  EXPECT_EQ(q(-1e3), -10);
}

}  // namespace
}  // namespace ambrig
