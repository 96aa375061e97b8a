/// The lockstep update of the lanes against closed forms of RL circuits, with its order of
/// convergence and its energy balance.
#include "actuators/magnetics/stator_lanes.h"

#include <gtest/gtest.h>

#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

constexpr double kT = 40e-6;
// A trapezoid's step errs by (h/τ)³/12 of the distance to the settled current, 60 A at most here.
constexpr double kPerStep = 60 * (kT / 18 / 3.5e-3) * (kT / 18 / 3.5e-3) * (kT / 18 / 3.5e-3) / 12;

/// A single uncoupled coil of [loadcurrentslope]: 1.75 mH, 0.5 ohm.
StatorLanes PaperCoil(double h) {
  StatorLanes lanes;
  lanes.coupling = Coupling::kNone;
  lanes.coils = 1;
  lanes.n[0] = 1;
  lanes.leakage[0] = 1.75e-3 - 1e-6;
  lanes.resistance[0] = 0.5;
  lanes.direction_x[0] = 1;
  lanes.gap_offset[0] = 1;
  lanes.reluctance.per_metre = 1e6;  // one metre of gap: 1 uH
  lanes.Settle({{0.5}}, 0, 0);
  lanes.SetStep(h);
  return lanes;
}

// published_values.md 1: with U_d - 2 U_s = 29.75 V the slope at zero current is 17 000 A/s less
// 0.25 V / 1.75 mH at 0.5 A: 16 857.1 A/s, and 16 761.1 after 20 us of Eq. 9. The trapezoid holds
// them to (R h/2L)²/3.
TEST(StatorLanes, PaperSlopesOfOneCoil) {
  const double h = kT / 18;
  StatorLanes lanes = PaperCoil(h);
  lanes.RunPeriod(Constant({{29.75}}), 30, 0, 0, 0, 0, 18);
  const double tau = 3.5e-3, settled = 29.75 / 0.5;
  for (int k = 0; k < 18; ++k)
    EXPECT_NEAR(lanes.samples[k][0], settled + (0.5 - settled) * std::exp(-k * h / tau),
                (k + 0.01) * kPerStep)
        << k;
  const double slope = (lanes.samples[1][0] - lanes.samples[0][0]) / h;
  EXPECT_NEAR(slope, 16857.1 * (1 - 0.5 * h / tau), 0.1);
  const double later = (lanes.samples[10][0] - lanes.samples[9][0]) / h;
  EXPECT_NEAR(later, 16761.1 * (1 - 0.5 * h / tau), 0.1);
}

// i_(n+1) = i_n (1 - a)/(1 + a) + h v/(L (1 + a)), a = R h/2L: what a trapezoid must be, to
// rounding.
TEST(StatorLanes, StepIsTheTrapezoid) {
  const double h = kT / 2, a = 0.5 * h / 3.5e-3;
  StatorLanes lanes = PaperCoil(h);
  double i = 0.5;
  for (int n = 0; n < 50; ++n) {
    lanes.RunPeriod(Constant({{n % 2 == 0 ? 29.75 : -25.0}}), 30, 0, 0, 0, 0, 2);
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(lanes.samples[k][0], i, 1e-13);
      i = i * (1 - a) / (1 + a) + h * (n % 2 == 0 ? 29.75 : -25.0) / (1.75e-3 * (1 + a));
    }
  }
}

TEST(StatorLanes, ConvergesWithOrderTwo) {
  double error[3];
  for (int level = 0; level < 3; ++level) {
    const int steps = 4 << level;
    StatorLanes lanes = PaperCoil(10 * kT / steps);
    lanes.RunPeriod(Constant({{29.75}}), 30, 0, 0, 0, 0, steps);
    error[level] = std::abs(lanes.i[0] - (59.5 + (0.5 - 59.5) * std::exp(-10 * kT / 3.5e-3)));
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.01);
  EXPECT_NEAR(std::log2(error[1] / error[2]), 2, 0.01);
}

// A switching edge anywhere inside a sample: its volt-seconds are exact, so a coil without
// resistance is.
TEST(StatorLanes, EdgeInsideASampleIsExact) {
  for (double edge : {0.31 * kT, 0.5 * kT, 0.777 * kT}) {
    StatorLanes lanes = PaperCoil(kT / 18);
    lanes.resistance[0] = 0;
    lanes.SetStep(kT / 18);
    VoltagePattern p;
    p.t2[0] = edge;
    p.gain[1][0] = 1;
    p.gain[0][0] = p.gain[2][0] = -1;
    lanes.RunPeriod(p, 10, 0, 0, 0, 0, 18);
    EXPECT_NEAR(lanes.i[0], 0.5 + 10 * (2 * edge - kT) / 1.75e-3, 1e-12) << edge;
  }
}

// Off at -31.4 V the diodes end the current at t = τ ln(1 + i0 R/V); then nothing, until the switch
// closes.
TEST(StatorLanes, DiodesEndTheCurrent) {
  const double h = kT / 18, V = 31.4, ends = 3.5e-3 * std::log1p(0.5 * 0.5 / V);
  for (bool general : {false, true}) {
    StatorLanes lanes = PaperCoil(h);
    const VoltagePattern off = Constant({{-V}});
    if (general) {
      lanes.BeginPeriod(0, 0, 0, 0, 18);
      for (int k = 0; k < 18; ++k) lanes.StepSample(off, 30, k);
      lanes.EndPeriod();
    } else {
      lanes.RunPeriod(off, 30, 0, 0, 0, 0, 18);
    }
    for (int k = 0; k < 18; ++k) {
      const double t = k * h,
                   exact = t < ends ? -V / 0.5 + (0.5 + V / 0.5) * std::exp(-t / 3.5e-3) : 0;
      EXPECT_NEAR(lanes.samples[k][0], exact, (k + 1) * 1.1 * kPerStep) << k;
      EXPECT_GE(lanes.samples[k][0], 0);
    }
    EXPECT_EQ(lanes.i[0], 0);
    lanes.RunPeriod(Constant({{29.75}}), 30, 0, 0, 0, 0, 18);
    EXPECT_NEAR(lanes.samples[9][0], 59.5 * -std::expm1(-9 * h / 3.5e-3), 10 * kPerStep);
  }
}

// published_values.md 1.2: leakage a tenth of L0 = N² mu0 A/g0, NSNSNSNS, no resistance; slopes in
// U/L0.
TEST(StatorLanes, SlopesOfCoupledCoils) {
  const auto slopes = [](int opened, const Lane& volts) {
    StatorLanes lanes = LanesOf("A");
    const double L0 = lanes.n[0] * lanes.n[0] / lanes.reluctance.Value(lanes.gap_offset[0]);
    lanes.leakage = All(0.1 * L0);
    lanes.resistance = All(0);
    lanes.SetStep(kT / 18);
    lanes.Settle(All(2), 0, 0);
    if (opened >= 0) lanes.Break(opened, 0, 0);
    const Lane before = lanes.i;
    lanes.RunPeriod(Constant(volts), 30, 0, 0, 0, 0, 18);
    Lane out;
    for (int j = 0; j < kLanes; ++j) out[j] = (lanes.i[j] - before[j]) / kT * L0 / 10;
    return out;
  };
  const Lane together = slopes(-1, All(10));
  for (double s : together.v) EXPECT_NEAR(s, 0.909, 5e-4);
  const Lane open = slopes(3, All(10));  // the four of the other winding sense have the majority
  for (int j = 0; j < kLanes; ++j)
    EXPECT_NEAR(open[j], j == 3 ? 0 : j % 2 == 0 ? 1.414 : 0.404, 5e-4) << j;
  Lane one;
  one[0] = 10;
  EXPECT_NEAR(slopes(-1, one)[0], 2.045, 5e-4);  // the others held at 0 V
}

// The motion's own voltage: at fixed linkage (no voltage, no resistance) the currents of a moving
// rotor are those that Refresh finds at its new place.
TEST(StatorLanes, MotionChangesCurrentsAtFixedLinkage) {
  StatorLanes lanes = LanesOf("A");
  lanes.resistance = All(0);
  lanes.SetStep(kT / 18);
  lanes.Settle(All(2), 0, 0);
  StatorLanes there = lanes;
  lanes.RunPeriod(Constant(All(0)), 30, 0, 0, 5e-5, -2e-5, 18);
  there.Refresh(5e-5, -2e-5);
  for (int j = 0; j < kLanes; ++j) EXPECT_NEAR(lanes.i[j], there.i[j], 1e-12);
  EXPECT_GT(std::abs(lanes.i[0] - 2), 0.05);
}

/// Electrical input - copper - field - work on the rotor over some periods along a path, relative
/// to the input. Mean of current and flux over each step, as the update has them.
double EnergyLeft(int steps) {
  StatorLanes lanes = LanesOf("A");
  const double h = kT / steps, speed = 0.1;  // [m/s]
  lanes.SetStep(h);
  lanes.Settle({{2.4, 1.9, 1.7, 3.1, 2.2, 1.4, 2.2, 2.9}}, 0, 0);
  VoltagePattern p;
  for (int j = 0; j < kLanes; ++j) {
    p.t2[j] = (0.3 + 0.05 * j) * kT;
    p.gain[1][j] = 1;
    p.gain[0][j] = p.gain[2][j] = -1;
  }
  double input = 0, copper = 0, work = 0;
  const double before = lanes.FieldEnergy(0, 0);
  double x = 0;
  for (int n = 0; n < 5; ++n) {
    const double next = x + speed * kT;
    lanes.BeginPeriod(x, 0, next, 0, steps);
    for (int k = 0; k < steps; ++k) {
      const Lane i0 = lanes.i;
      lanes.StepSample(p, 30, k);
      input += 30 * h * lanes.BusCurrent(p, k);
      for (int j = 0; j < kLanes; ++j) {
        const double mean = 0.5 * (i0[j] + lanes.i[j]);
        copper += h * lanes.resistance[j] * mean * mean;
      }
    }
    lanes.EndPeriod();
    work += lanes.fx * speed * kT;
    x = next;
  }
  const double field = lanes.FieldEnergy(x, 0) - before;
  EXPECT_GT(std::abs(work), 1e-5);
  return (input - copper - field - work) / (std::abs(input) + std::abs(field));
}

// Electrical = copper + field + mechanical: what is left falls with the square of the step.
TEST(StatorLanes, EnergyBalanceOverAMovingGap) {
  const double once = EnergyLeft(18), twice = EnergyLeft(36), four = EnergyLeft(72);
  RecordProperty("left_of_the_input", std::to_string(once * 1e6) + "e-6");
  EXPECT_LT(std::abs(once), 1e-3);
  EXPECT_NEAR(std::log2(std::abs(once / four)) / 2, 2, 0.3) << once << " " << twice << " " << four;
}

}  // namespace
}  // namespace ambrig
