// The detector of [loadcurrentslope] against the numbers of that paper.
#include "fdd/detectors/slope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <tuple>

#include "actuators/electronics/coil_voltage.h"
#include "control/current/current_regulator.h"

namespace ambrig {
namespace {

/// One uncoupled RL coil behind the simulator's own regulator and bridge, exact between edges.
class RlCoil {
 public:
  RlCoil(double inductance, double resistance, const AmplifierParameters& a)
      : L(inductance), R(resistance), a_(a), regulator_(a_) {
    regulator_.HoldCurrent(0, R);
  }
  /// One period at a set-point; calls `sample` with i at its 18 instants.
  void Period(double set, const std::function<void(double)>& sample) {
    const double duty = regulator_.Duty(set, mean_), T = 1 / a_.switching_frequency;
    const CoilVoltage v = IdealBridgeVoltage(a_, duty);
    double sum = 0;
    for (int k = 0; k < 18; ++k) {
      sample(i);
      sum += i;
      const double t0 = k * T / 18, t1 = (k + 1) * T / 18;
      const double edge = std::clamp(v.t2, t0, t1);
      Advance(v.gain[1] * bus + v.drop[1], edge - t0);
      Advance(v.gain[2] * bus + v.drop[2], t1 - edge);
    }
    mean_ = sum / 18;
  }
  double L, R, i = 0, bus = 30;
  bool open = false;

 private:
  void Advance(double u, double dt) {
    const double settled = u / R;
    i = open ? 0 : std::max(0.0, settled + (i - settled) * std::exp(-R / L * dt));
  }
  AmplifierParameters a_;
  CurrentRegulator regulator_;
  double mean_ = 0;
};

AmplifierParameters PaperAmplifier() {
  AmplifierParameters a;
  a.bus_voltage = 30;
  a.switching_frequency = 25e3;
  a.kp = 4;
  a.ki = 2000;
  a.i_max = 5;
  return a;
}

SlopeConverter FineConverter() {
  SlopeConverter c;
  c.reference = 1.25;  // a 1.25 A full scale: 0.3 mA a code
  c.bits = 12;
  return c;
}

TEST(PaperSlope, Equation9GivesThePublishedRange) {
  SlopeCircuit c;
  c.switch_drop = 0.125;  // 2 U_s = 0.25 V, docs/theory/published_values.md 1
  const SlopeRange range = IncreasingRange(c, 0.5);
  EXPECT_NEAR(range.low, 16761, 0.5);
  EXPECT_NEAR(range.high, 16857, 0.5);
  c.diode_drop = 0.125;
  EXPECT_NEAR(DecreasingSlope(c, 0.5), -17428.6, 0.05);
  c.switch_drop = 0;
  EXPECT_NEAR(IncreasingSlope(c, 0.5), 17000.0, 0.05);
  EXPECT_NEAR(IncreasingRange(c, 0.5).low, 16903.1, 0.1);
}

TEST(PaperSlope, Equation19CountsToAmperesPerSecond) {
  SlopeConverter c;
  c.attenuation = 2;
  c.sampling_resistance = 4;
  c.reference = 3;
  c.bits = 12;
  c.period = 2.5e-6;
  // 2 * 10 * 3 / (4096 * 4 * 2.5e-6)
  EXPECT_DOUBLE_EQ(c.Slope(100, 110), 60.0 / (4096 * 4 * 2.5e-6));
  EXPECT_EQ(c.Code(1.0), std::lround(4.0 / 2 / 3 * 4096));
}

TEST(PaperSlope, SingularSlopesAreCancelled) {
  SlopeConverter c;
  c.attenuation = c.sampling_resistance = 1;
  c.reference = 1;
  c.bits = 0;
  c.period = 1;
  // Slopes: +1 +1 +1 -9 +1 +1 +1 +1 -1 -1 -1 -1; kept: those whose both neighbours have their sign.
  const MeanSlopes m = MeanSlopesOf(c, {0, 1, 2, 3, -6, -5, -4, -3, -2, -3, -4, -5, -6});
  EXPECT_EQ(m.kept_increasing, 3);
  EXPECT_EQ(m.kept_decreasing, 2);
  EXPECT_EQ(m.cancelled, 7);
  EXPECT_DOUBLE_EQ(m.increasing, 1);
  EXPECT_DOUBLE_EQ(m.decreasing, -1);
}

// Numbers that are exact in binary: slopes of +-3 A/s. A limit belongs to the range, all that is
// beyond does not.
TEST(PaperSlope, ASlopeAtALimitIsWithin) {
  for (const auto& [bus, margin, expected] : {std::tuple{2.0, 1.0, FaultClass::kNone},
                                              {2.0, 0.5, FaultClass::kPartialShort},
                                              {4.0, 1.0, FaultClass::kNone},
                                              {4.0, 0.5, FaultClass::kOpen}}) {
    SlopeDetectorSettings s;
    s.converter.attenuation = s.converter.sampling_resistance = s.converter.reference = 1;
    s.converter.bits = 0;
    s.converter.period = 1;
    s.circuit = {bus, 0, 0, 1, 0, 1};  // 1 H, no resistance: slopes of +-bus
    s.margin = margin;
    s.samples_per_period = 10;
    SlopeDetector detector(s);
    for (const long code : {0, 3, 6, 9, 12, 15, 12, 9, 6, 3}) detector.Sample(code, 0);
    EXPECT_EQ(detector.slopes().increasing, 3);
    EXPECT_EQ(detector.slopes().decreasing, -3);
    EXPECT_EQ(detector.fault_class(), expected) << bus << " " << margin;
  }
}

TEST(PaperSlope, ErrorBudgetOfSection41) {
  SlopeCircuit c;
  const double k = IncreasingSlope(c, 0.5);
  SlopeCircuit shifted = c;
  shifted.bus += 0.020;
  EXPECT_NEAR(IncreasingSlope(shifted, 0.5) - k, 12, 1);  // 20 mV
  shifted = c;
  shifted.bus += 1;
  EXPECT_NEAR(IncreasingSlope(shifted, 0.5) - k, 570, 2);  // 1 V of bus pumping
  shifted = c;
  shifted.inductance -= 0.011e-3;
  const double by_gap = IncreasingSlope(shifted, 0.5) - k;  // computed 106, published 120
  EXPECT_GT(by_gap, 100);
  EXPECT_LT(by_gap, 120);
}

struct Coil {
  double R, L;
};
void PrintTo(const Coil& coil, std::ostream* out) { *out << coil.R << " ohm, " << coil.L << " H"; }
class PaperCoils : public ::testing::TestWithParam<Coil> {};

TEST_P(PaperCoils, SimulatedSlopesLieInTheTheoreticalRange) {
  const Coil p = GetParam();
  RlCoil coil(p.L, p.R, PaperAmplifier());
  SlopeConverter fine = FineConverter();
  fine.reference = 4;
  fine.bits = 20;  // no quantisation: theory against simulation
  SlopeCircuit circuit;
  circuit.inductance = p.L;
  circuit.resistance = p.R;
  for (int n = 0; n < 2000; ++n) {
    std::vector<long> codes;
    const double i0 = coil.i;
    coil.Period(1.0, [&](double i) { codes.push_back(fine.Code(i)); });
    if (n < 1000) continue;  // the step of 1 A has settled
    const MeanSlopes m = MeanSlopesOf(fine, codes);
    ASSERT_GE(m.kept_increasing, 4);
    // Half a code over the kept differences: 2e-6 A / (5 * 2.2 us) < 1 A/s; 5 for both ends.
    EXPECT_TRUE(IncreasingRange(circuit, i0, 5).Contains(m.increasing)) << m.increasing;
    // The off phase starts from the crest: i0 plus the rise of the on phase.
    const double crest = i0 + IncreasingSlope(circuit, i0) * 20.5e-6;
    const SlopeRange down = DecreasingRange(circuit, crest, 5);
    EXPECT_TRUE(down.Contains(m.decreasing)) << m.decreasing << " " << down.low << " " << down.high;
  }
  // valley of the ripple: the step is followed
  EXPECT_NEAR(coil.i, 1.0 - 0.5 * 30 / p.L * 20e-6, 0.02);
}
INSTANTIATE_TEST_SUITE_P(Figures4And5, PaperCoils,
                         ::testing::Values(Coil{0.5, 2e-3}, Coil{0.2, 1e-3}));

/// Coil of section 4 at its working point.
MeanSlopes OnePeriod(RlCoil& coil, const SlopeConverter& converter) {
  std::vector<long> codes;
  coil.Period(0.7, [&](double i) { codes.push_back(converter.Code(i)); });
  return MeanSlopesOf(converter, codes);
}

TEST(PaperSlope, HistogramOf2000PeriodsStaysWithin700) {
  RlCoil coil(1.75e-3, 0.5, PaperAmplifier());
  const SlopeConverter converter = FineConverter();
  for (int n = 0; n < 1000; ++n) OnePeriod(coil, converter);
  const double centre = OnePeriod(coil, converter).increasing;
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<double> k;
  for (int n = 0; n < 2000; ++n) {
    coil.bus = 30 + std::sin(0.1 * n) + 0.02 * u(generator);  // pumping of 1 V peak, 20 mV analogue
    coil.L = 1.75e-3 + 0.011e-3 * u(generator);               // gap
    k.push_back(OnePeriod(coil, converter).increasing - centre);
  }
  const auto [low, high] = std::minmax_element(k.begin(), k.end());
  EXPECT_GT(*low, -700);
  EXPECT_LT(*high, 700);
  EXPECT_GT(*high - *low, 1000);  // the bus alone makes +-570
}

class PaperFaults : public ::testing::TestWithParam<double> {};  // turns left; 0: open

TEST_P(PaperFaults, FlaggedWithinAboutTwoMilliseconds) {
  const double turns = GetParam();
  for (int phase = 0; phase < 44; ++phase) {  // every place of the fault within the 1.75 ms cycle
    RlCoil coil(1.75e-3, 0.5, PaperAmplifier());
    SlopeDetectorSettings s;
    s.converter = FineConverter();
    s.cycle = 1.75e-3;
    SlopeDetector detector(s);
    for (int n = 0; n < 1000; ++n) coil.Period(0.7, [](double) {});
    double fault = -1, flag = -1, t = 0;
    std::mt19937 generator(static_cast<unsigned>(phase));
    std::uniform_real_distribution<double> u(-1, 1);
    for (int n = 0; n < 600 && flag < 0; ++n) {
      if (n == 400 + phase) {
        fault = t;
        coil.open = turns == 0;
        if (turns > 0) coil.L *= turns * turns, coil.R *= turns;
      }
      coil.bus = 30 + 0.5 * u(generator);
      const double i0 = coil.i;
      coil.Period(0.7, [&](double i) {
        t += 1 / 450e3;
        if (detector.Sample(s.converter.Code(i), i0)) flag = t;
      });
    }
    ASSERT_GT(fault, 0);
    EXPECT_GT(flag, fault) << "false alarm";
    EXPECT_LT(flag - fault, 2e-3);
    EXPECT_EQ(detector.fault_class(), turns == 0 ? FaultClass::kOpen : FaultClass::kPartialShort);
  }
}
INSTANTIATE_TEST_SUITE_P(OpenAndShorts, PaperFaults, ::testing::Values(0.0, 0.5, 0.8, 0.9));

}  // namespace
}  // namespace ambrig
