// The paper's detector as a statistic, thresholds fixed and online; current error; levels.
#include "fdd/detectors/slope_statistic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fdd/detectors/coupled_detector.h"
#include "fdd/detectors/current_error.h"
#include "fdd/detectors/slope_prediction.h"
#include "fdd/detectors/statistic_level.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;
using Thresholds = SlopeStatistic::Thresholds;

/// Uncoupled coils with ideal slopes: v = U - R i on, -(U + ..) off, L of all coils in phase.
struct IdealCoil {
  Bench bench;
  CoilDetectorSetup setup = SetupOf(bench);
  Lane adc[kSamples], duty, set;
  double bus = 30, x = 0;

  IdealCoil() {
    setup.settings.current_quantum = 1e-6;
    for (double& d : duty.v) d = 0.5;
    for (double& i : set.v) i = 2;
  }
  MeasuredPeriod Period(double inductance, double resistance) {
    const AmplifierParameters& a = bench.amplifier;
    const double h = kT / kSamples;
    double i = 2;
    for (int k = 0; k < kSamples; ++k) {
      for (double& v : adc[k].v) v = i;
      const double v = k < kSamples / 2 ? bus - 2 * a.switch_drop : -(bus + 2 * a.diode_drop);
      i = v / resistance + (i - v / resistance) * std::exp(-h * resistance / inductance);
    }
    MeasuredPeriod in;
    in.adc = adc;
    in.duty = &duty;
    in.set_point = &set;
    in.bus = bus;
    in.x0 = in.x1 = x;
    return in;
  }
};

constexpr double kInPhase = 1.6e-3 + 0.35e-3;  // facts: N² mu0 A/g0 + L_l [H]

TEST(SlopeStatistic, InPhaseInductanceOfTheReferenceRig) {
  const LinkageModel m = MakeLinkageModel(Reference());
  EXPECT_NEAR(InPhaseInductance(m, 3, m.Permeance(0, 0)), kInPhase, 1e-7);
}

TEST(SlopeStatistic, BusPumpingMovesFixedThresholdsOnly) {
  IdealCoil coil;
  SlopeStatistic fixed(coil.setup, Thresholds::kFixed), online(coil.setup, Thresholds::kOnline);
  // The off phase starts at the crest: i R there is R 0.3 A more than the paper's i0 R, 77 A/s.
  EXPECT_LT(fixed.Period(coil.Period(kInPhase, 0.5))[0], 0.12);
  EXPECT_LT(online.Period(coil.Period(kInPhase, 0.5))[0], 0.12);
  coil.bus = 33;
  // 3 V / 1.95 mH = 1538 A/s.
  EXPECT_NEAR(fixed.Period(coil.Period(kInPhase, 0.5))[0], 3 / kInPhase / 700, 0.15);
  EXPECT_LT(online.Period(coil.Period(kInPhase, 0.5))[0], 0.15);
}

TEST(SlopeStatistic, GapMovesFixedThresholdsOnly) {
  IdealCoil coil;
  SlopeStatistic fixed(coil.setup, Thresholds::kFixed), online(coil.setup, Thresholds::kOnline);
  coil.x = 1e-4;
  const LinkageModel m = coil.setup.model;
  const double L = InPhaseInductance(m, 0, m.Permeance(coil.x, 0));
  EXPECT_GT(L, 1.2 * kInPhase);
  EXPECT_GT(fixed.Period(coil.Period(L, 0.5))[0], 3);
  EXPECT_LT(online.Period(coil.Period(L, 0.5))[0], 0.15);
}

TEST(SlopeStatistic, ResistanceIsLearnedFromMeans) {
  IdealCoil coil;
  SlopeStatistic online(coil.setup, Thresholds::kOnline);
  // 40 % more resistance (about 100 K): the mean voltage that holds 2 A is 1.4 V, not 1.0 V.
  coil.bus = 30;
  const AmplifierParameters& a = coil.bench.amplifier;
  const MeasuredPeriod one = coil.Period(kInPhase, 0.7);
  double mean = 0;
  for (const Lane& i : coil.adc) mean += i[0] / kSamples;
  const double up = 30 - 2 * a.switch_drop, down = 30 + 2 * a.diode_drop;
  for (double& d : coil.duty.v) d = (0.7 * mean + down) / (up + down);
  for (int n = 0; n < 5000; ++n) online.Period(one);
  // the prior still has a third of the weight
  EXPECT_NEAR(online.resistance().Value(0), 0.7, 0.06);
  EXPECT_GT(online.resistance().Value(0), 0.6);
}

TEST(SlopeStatistic, AboveOneWhereThePapersDetectorFlags) {
  for (double factor : {1.0, 0.97, 0.9, 0.81, 1.1}) {
    IdealCoil coil;
    const MeasuredPeriod in = coil.Period(kInPhase * factor, 0.5);
    SlopeStatistic statistic(coil.setup, Thresholds::kFixed);
    SlopeDetectorSettings s;
    s.converter = {1, 1, 1e-6, 0, kT / kSamples};
    s.circuit = {30,  0.125,
                 0.7, InPhaseInductance(coil.setup.model, 0, coil.setup.model.Permeance(0, 0)),
                 0.5, kT};
    s.margin = 700;
    SlopeDetector paper(s);
    for (const Lane& i : coil.adc) paper.Sample(s.converter.Code(i[0]), coil.adc[0][0]);
    EXPECT_EQ(statistic.Period(in)[0] > 1, paper.flagged()) << factor;
  }
}

TEST(SlopeStatistic, LooksOnceInACycle) {
  IdealCoil coil;
  SlopeStatistic paper(coil.setup, Thresholds::kFixed, 1.75e-3);
  int looks = 0;
  double before = 0;
  for (int n = 0; n < 440; ++n) {
    coil.bus = 20 + 0.02 * n;  // another slope in every period
    const double now = paper.Period(coil.Period(kInPhase, 0.5))[0];
    looks += now != before ? 1 : 0;
    before = now;
  }
  EXPECT_EQ(looks, 10);  // 1.75 ms are 43.75 periods: the first one at or after it, 44
}

TEST(SlopePrediction, KnowsNeighboursGapAndMotion) {
  Bench bench;
  bench.vx = 0.1;
  const CoilDetectorSetup setup = SetupOf(bench);
  SlopePrediction coupled(setup);
  SlopeStatistic online(setup, Thresholds::kOnline);
  double worst_online = 0;
  for (int n = 0; n < 10; ++n) {
    // flux-free pattern: leakage alone
    for (int j = 0; j < kLanes; ++j) bench.duty[j] = 0.515 + (j % 2 == 0 ? 0.02 : -0.02);
    for (double& i : bench.lanes.i.v) ASSERT_GT(i, 0.1);
    const MeasuredPeriod in = bench.Run();
    // 100 A/s: explicit R i, linear L^-1
    for (double s : coupled.Period(in).v) EXPECT_LT(s, 0.15) << n;
    for (double s : online.Period(in).v) worst_online = std::max(worst_online, s);
  }
  EXPECT_GT(worst_online, 2);
  // A short of 5 % of the turns of one coil: slopes (L_short^-1 - L^-1) v, v = -(U + 2 U_c) - R i
  // in the off phase.
  for (double& d : bench.duty.v) d = 0.515;
  bench.vx = 0;
  bench.lanes.ShortTurns(3, 0.05, INFINITY, bench.x0, bench.y0);
  const Lane s = coupled.Period(bench.Run());
  LinkageModel shorted = setup.model;
  shorted.n[3] *= 0.95;
  shorted.leakage[3] *= 0.95 * 0.95;
  const Lane P = shorted.Permeance(bench.x0, bench.y0);
  LinkageVector v;
  for (int j = 0; j < kLanes; ++j) v[j] = -31.4 - 0.5 * bench.lanes.samples[13][j];
  const LinkageVector change =
      InductanceOf(shorted, P).inverse() * v - InductanceOf(setup.model, P).inverse() * v;
  EXPECT_NEAR(s[3], std::abs(change[3]) / 700, 0.2);
  EXPECT_GT(s[3], 3);
  for (int j = 0; j < kLanes; ++j) EXPECT_LE(s[j], s[3]) << j;
}

TEST(SlopePrediction, AnOpenCoilMissesItsWholeSlope) {
  Bench bench;
  bench.noise = 0.004;
  SlopePrediction coupled(SetupOf(bench));
  for (int n = 0; n < 5; ++n) coupled.Period(bench.Run());
  bench.lanes.Break(2, bench.x0, bench.y0);
  const Lane s = coupled.Period(bench.Run());
  EXPECT_GT(s[2], 15);  // 15 kA/s and more are gone
}

TEST(CurrentErrorDetector, FollowsAStepAndNamesALostCurrent) {
  IdealCoil coil;
  CurrentErrorDetector detector(coil.setup);
  MeasuredPeriod in = coil.Period(kInPhase, 0.5);
  for (Lane& sample : coil.adc)
    for (double& v : sample.v) v = 2;
  for (int n = 0; n < 20; ++n) EXPECT_LT(detector.Period(in)[0], 1e-9);
  // A step of the set-point that the loop follows with its lag L/kp = 0.49 ms.
  for (double& i : coil.set.v) i = 3;
  double lag = 0;
  for (int n = 0; n < 100; ++n) {
    lag += (1 - lag) * kT * 4 / kInPhase;
    in = coil.Period(kInPhase, 0.5);
    for (Lane& sample : coil.adc)
      for (double& v : sample.v) v = 2 + lag;
    EXPECT_LT(detector.Period(in)[0], 1e-9) << n;
  }
  // The current is gone: after five periods in a row the error is the set-point.
  for (int n = 0; n < 5; ++n) {
    for (Lane& sample : coil.adc) sample[4] = 0;
    const Lane s = detector.Period(in);
    EXPECT_NEAR(s[4], n < 4 ? 0 : 3, 0.01) << n;
    EXPECT_LT(s[3], 0.01);
  }
}

// The statistic is the shipped detector's: its alarm comes in the period in which the sum passes 9.
TEST(CoupledDetector, PassesNineWhereTheDetectorAlarms) {
  for (int coil = 0; coil < kLanes; ++coil) {
    Bench bench;
    bench.noise = 0.004;
    bench.seed = static_cast<std::uint64_t>(coil) + 1;
    const CoilDetectorSetup setup = SetupOf(bench);
    CoupledDetector statistic(setup);
    BearingDetector detector(setup.model, setup.settings);
    int over = -1, raised = -1;
    for (int n = 0; n < 100 && raised < 0; ++n) {
      if (n == 60) bench.lanes.ShortTurns(coil, 0.05, INFINITY, bench.x0, bench.y0);
      const MeasuredPeriod in = bench.Run();
      const Lane s = statistic.Period(in);
      if (over < 0 && *std::max_element(s.v, s.v + kLanes) > 9) {
        over = n;
        EXPECT_EQ(std::max_element(s.v, s.v + kLanes) - s.v, coil);
      }
      if (detector.Period(in).raised) raised = n;
    }
    EXPECT_GE(over, 60);
    EXPECT_GE(raised, over);
    EXPECT_LE(raised, over + 2);  // the name of the coil may take two periods more
  }
}

TEST(StatisticLevel, FindsItsPlace) {
  for (int k = 0; k < kStatisticLevels; ++k) EXPECT_EQ(LevelOf(ValueOf(k)), k);
  for (int k = 1; k + 1 < kStatisticLevels; ++k)
    EXPECT_EQ(LevelOf(0.5 * (ValueOf(k) + ValueOf(k + 1))), k);
  EXPECT_EQ(LevelOf(0), 0);
  EXPECT_EQ(LevelAtLeast(ValueOf(40)), 40);
  EXPECT_EQ(LevelAtLeast(1.001 * ValueOf(40)), 41);
  EXPECT_EQ(LevelOf(1e300), kStatisticLevels - 1);
  EXPECT_EQ(LevelOf(NAN), kStatisticLevels - 1);
  EXPECT_NEAR(ValueOf(1 + 2 * kLevelsPerDecade) / ValueOf(1 + kLevelsPerDecade), 10, 1e-9);
}

}  // namespace
}  // namespace ambrig
