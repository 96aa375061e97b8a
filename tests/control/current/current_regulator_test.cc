/// The current regulator: exact discrete PI, anti-windup, standing start.
#include "control/current/current_regulator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "actuators/electronics/coil_voltage.h"
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

// u_n = kp e_n + Σ_(m<=n) ki T e_m, d = 0.5 + u/(2 U_d): the increment of this period included.
TEST(CurrentRegulator, IsTheDiscretePi) {
  const AmplifierParameters p = Reference();
  CurrentRegulator a(p);
  a.set_integral(0.4);
  double integral = 0.4;
  for (int n = 0; n < 40; ++n) {
    const double e = 0.5 * std::sin(0.3 * n);
    integral += 2000 * 40e-6 * e;
    EXPECT_NEAR(a.Duty(2 + e, 2), 0.5 + (4 * e + integral) / 60, 1e-14) << n;
  }
}

// Beyond a limit on the side that e pushes to, the increment is dropped; on the other side it
// counts.
TEST(CurrentRegulator, IntegralStandsStillAtTheLimit) {
  const AmplifierParameters p = Reference();
  CurrentRegulator a(p);
  a.set_integral(27);
  for (int n = 0; n < 5; ++n) EXPECT_EQ(a.Duty(5, 0), 0.98);
  EXPECT_EQ(a.integral(), 27);
  EXPECT_NEAR(a.Duty(0, 0.1), 0.5 + (-0.4 + 27 - 0.008) / 60, 1e-14);
  EXPECT_NEAR(a.integral(), 27 - 0.008, 1e-14);
  // The tentative duty is beyond the limit only through its increment: dropped, not clamped.
  a.set_integral(28.7596);
  EXPECT_NEAR(a.Duty(0.01, 0), 0.5 + (0.04 + 28.7596) / 60, 1e-14);
  a.set_integral(-30);
  EXPECT_EQ(a.Duty(0, 1), 0.02);
  EXPECT_EQ(a.integral(), -30);
}

// A standing start: with no error the duty's mean voltage is R i, for every modulation.
TEST(CurrentRegulator, HoldCurrentStandsStill) {
  for (Modulation m :
       {Modulation::kBiState, Modulation::kTriState, Modulation::kChopper, Modulation::kIdeal})
    for (double quadrants : {2.0, 4.0}) {
      AmplifierParameters p = Reference(m);
      p.quadrants = quadrants;
      CurrentRegulator a(p);
      a.HoldCurrent(3, 0.5);
      EXPECT_NEAR(Mean(IdealBridgeVoltage(p, a.Duty(3, 3)), 30, 40e-6), 1.5, 1e-12)
          << static_cast<int>(m) << quadrants;
    }
}

TEST(CurrentRegulator, ACoilToldNoCurrentStartsAtTheLowerLimit) {
  const AmplifierParameters p = Reference();
  CurrentRegulator a(p);
  a.HoldCurrent(0.2, 0.5);
  EXPECT_NEAR(a.integral(), 60 * (0.02 - 0.5), 1e-12);
  EXPECT_NEAR(a.Duty(0, 0), 0.02, 1e-15);
}

}  // namespace
}  // namespace ambrig
