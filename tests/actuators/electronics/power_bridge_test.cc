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

// With all switches open the diodes lead the current back into the bus, whatever its sign and the
// duty.
TEST(PowerBridge, AnOpenBridgeActsAgainstTheCurrent) {
  AmplifierParameters p = Reference();
  p.quadrants = 4;
  BridgeImperfection bridge;
  bridge.off = true;
  for (const Modulation m : {Modulation::kBiState, Modulation::kTriState, Modulation::kIdeal}) {
    p.modulation = m;
    for (const double duty : {0.1, 0.9}) {
      EXPECT_NEAR(Mean(PowerBridge(p).Pattern(duty, bridge, 2), 30, 40e-6), -31.4, 1e-12);
      EXPECT_NEAR(Mean(PowerBridge(p).Pattern(duty, bridge, -2), 30, 40e-6), 31.4, 1e-12);
    }
  }
  EXPECT_TRUE(PowerBridge(p).Pattern(0.5, bridge, 2).released);
  EXPECT_FALSE(PowerBridge(p).Pattern(0.5, {}, 2).released);
  bridge.stuck_on = true;  // a switch that stays on keeps the coil at the bus
  EXPECT_FALSE(PowerBridge(p).Pattern(0.5, bridge, 2).released);
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

// A bridge whose switch stays on has no edges: dead time takes nothing of its voltage.
TEST(PowerBridge, ABridgeThatIsStuckOnHasNoDeadTime) {
  for (const Modulation m : {Modulation::kBiState, Modulation::kTriState, Modulation::kChopper}) {
    const PowerBridge a(Reference(m));
    BridgeImperfection stuck, late;
    stuck.stuck_on = late.stuck_on = true;
    late.dead_time = 1e-6;
    for (const double duty : {0.02, 0.7})
      EXPECT_EQ(Mean(a.Pattern(duty, late), 30, 40e-6), Mean(a.Pattern(1, {}), 30, 40e-6));
  }
}

// What comes out of a bridge within its dead duty is what it gives at rest: a tri-state bridge then
// freewheels at a half, the others are off.
TEST(PowerBridge, NothingComesOutBelowTheDeadDuty) {
  BridgeImperfection dead;
  dead.dead_duty = 0.1;
  const PowerBridge tri(Reference(Modulation::kTriState));
  for (const double duty : {0.46, 0.5, 0.54})
    EXPECT_EQ(Mean(tri.Pattern(duty, dead), 30, 40e-6), Mean(tri.Pattern(0.5, {}), 30, 40e-6));
  EXPECT_EQ(Mean(tri.Pattern(0.6, dead), 30, 40e-6), Mean(tri.Pattern(0.6, {}), 30, 40e-6));
  for (const Modulation m : {Modulation::kBiState, Modulation::kChopper}) {
    const PowerBridge a(Reference(m));
    EXPECT_EQ(Mean(a.Pattern(0.09, dead), 30, 40e-6), Mean(a.Pattern(0, {}), 30, 40e-6));
    EXPECT_EQ(Mean(a.Pattern(0.11, dead), 30, 40e-6), Mean(a.Pattern(0.11, {}), 30, 40e-6));
  }
}

// The end of an on-phase comes late: so much more of the bus; a bridge that does not switch has no
// edge.
TEST(PowerBridge, ALateEdgeLengthensTheOnPhase) {
  const double T = 40e-6, U = 30, late = 0.2e-6;
  BridgeImperfection bridge;
  for (const double sign : {-1.0, 1.0}) {
    bridge.late_edge = sign * late;
    for (Modulation m : {Modulation::kBiState, Modulation::kTriState, Modulation::kChopper}) {
      const AmplifierParameters p = Reference(m);
      const CoilVoltage exact = PowerBridge(p).Pattern(0.7, {});
      const double step = exact.gain[1] * U + exact.drop[1] - (exact.gain[2] * U + exact.drop[2]);
      EXPECT_NEAR(Mean(PowerBridge(p).Pattern(0.7, bridge), U, T) - Mean(exact, U, T),
                  step * sign * late / T, 1e-12);
    }
  }
  const PowerBridge still(Reference());
  for (const double duty : {0.0, 1.0})
    EXPECT_EQ(still.Pattern(duty, bridge).t2, still.Pattern(duty, {}).t2);
  EXPECT_EQ(PowerBridge(Reference(Modulation::kIdeal)).Pattern(0.5, bridge).t2, T);
  bridge.off = true;
  EXPECT_EQ(still.Pattern(0.7, bridge).t2, 0);
  bridge = {};
  bridge.late_edge = 1e-5;  // to the end of the period, no further
  EXPECT_EQ(still.Pattern(0.9, bridge).t2, T);
  bridge.late_edge = -1e-4;
  EXPECT_EQ(still.Pattern(0.9, bridge).t2, 0);
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

// Two bi-state legs half a period apart, whose mean the coil sees: voltage of the tri-state bridge
// at twice the frequency, drops and all ("interleaved" of a rig file is that bridge).
TEST(PowerBridge, InterleavedLegsAreATriStateBridgeAtTwiceTheFrequency) {
  AmplifierParameters leg = Reference(Modulation::kBiState),
                      both = Reference(Modulation::kTriState);
  leg.switching_frequency = 0.5 * both.switching_frequency;
  const double T = 1 / leg.switching_frequency, U = 120;
  const auto at = [U](const CoilVoltage& v, double t) {
    const int q = t < v.t1 ? 0 : t < v.t2 ? 1 : 2;
    return v.gain[q] * U + v.drop[q];
  };
  for (const double duty : {0.1, 0.37, 0.5, 0.62, 0.9}) {
    const CoilVoltage one = IdealBridgeVoltage(leg, duty), sum = IdealBridgeVoltage(both, duty);
    // The half period as distribution over the voltages: where in it they come depends on the
    // carriers.
    double legs[3] = {}, bridge[3] = {};
    constexpr int kInstants = 1000;
    for (int k = 0; k < kInstants; ++k) {
      const double t = (k + 0.5) / kInstants * T / 2;
      const double v = 0.5 * (at(one, t) + at(one, t + T / 2)), w = at(sum, t);
      ++legs[v > 0.5 * U ? 0 : v < -0.5 * U ? 1 : 2];
      ++bridge[w > 0.5 * U ? 0 : w < -0.5 * U ? 1 : 2];
      if (std::abs(v) < 0.5 * U) {
        EXPECT_NEAR(v, -(leg.switch_drop + leg.diode_drop), 1e-12);
      }
    }
    for (int level = 0; level < 3; ++level) EXPECT_NEAR(legs[level], bridge[level], 2) << duty;
  }
}

}  // namespace
}  // namespace ambrig
