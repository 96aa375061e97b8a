// The coupled detector's equations against the simulator's own stator, clamped and moving.
#include "fdd/detectors/bearing_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fdd/measurement/position_monitor.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

// The engine's trapezoid and moving reluctance leave 0.05 V: R h/2 di = 0.02 V, dP² terms the rest.
constexpr double kModelError = 0.08;

TEST(PeriodSlopes, HealthyCoilsObeyTheirEquationsOffCentreAndMoving) {
  Bench bench;
  bench.vx = 0.15;  // whirl at 60 % of the clearance, 12 000 rpm
  bench.vy = -0.1;
  std::mt19937 g(1);
  std::uniform_real_distribution<double> u(0.45, 0.58);
  const LinkageModel model = MakeLinkageModel(Reference());
  for (int n = 0; n < 5; ++n) {
    for (double& d : bench.duty.v) d = u(g);
    const MeasuredPeriod in = bench.Run();
    PeriodSlopes s;
    ComputePeriodSlopes(model, bench.Sampling(), in, &s);
    for (int j = 0; j < kLanes; ++j)
      for (int q = 0; q < 2; ++q)
        EXPECT_NEAR(s.phase[q].residual[j], 0, kModelError) << j << " " << q;
  }
  // The motion term is no detail: without it a coil is off by volts.
  MeasuredPeriod still = bench.Run();
  still.x1 = still.x0;
  still.y1 = still.y0;
  PeriodSlopes s;
  ComputePeriodSlopes(model, bench.Sampling(), still, &s);
  double worst = 0;
  for (double e : s.phase[0].residual.v) worst = std::max(worst, std::abs(e));
  EXPECT_GT(worst, 0.5);
}

TEST(PeriodSlopes, OneOpenCoilMovesAllSlopesButOnlyItsOwnResidual) {
  // published_values.md 1.2. With m_k = s_k di_k/dt, L0 (m_k - Σm/8) + L_l m_k = s_k v and m_j = 0
  // the slopes of the others change by -+(L0/8)/(L0/8 + L_l): 56 % for L_l = 0.1 L0, 36 % for this
  // rig.
  Bench healthy, broken;
  healthy.x0 = healthy.y0 = broken.x0 = broken.y0 = 0;
  healthy.Run();  // settle at the centre
  broken.Run();
  broken.lanes.Break(2, 0, 0);
  const LinkageModel model = MakeLinkageModel(Reference());
  PeriodSlopes a, b;
  ComputePeriodSlopes(model, healthy.Sampling(), healthy.Run(), &a);
  ComputePeriodSlopes(model, broken.Sampling(), broken.Run(), &b);
  for (int j = 0; j < kLanes; ++j) {
    const double change = b.phase[0].current[j] / a.phase[0].current[j] - 1;
    if (j == 2) {
      EXPECT_LT(b.phase[0].residual[j], -15);
    } else {
      const double sign = (j - 2) % 2 == 0 ? -1 : 1;  // same winding sense: slower
      // The break leaves Σ s i = 2 A * 1.95/0.55 = 7.1 A, so R Σ s i = 3.5 V of 29.75 V work
      // against it, and R (i_k - 2 A) = 0.36 V in each coil: 0.318 at once, growing with the decay
      // of Σ s i.
      EXPECT_NEAR(change, sign * 0.32, 0.015) << j;
      EXPECT_NEAR(b.phase[0].residual[j], 0, kModelError) << j;
    }
  }
}

TEST(PeriodSlopes, FalseSensorSpoilsTheOthersUntilItsMmfIsCalledUnknown) {
  Bench bench;
  bench.Run();
  MeasuredPeriod in = bench.Run();
  for (Lane& sample : bench.adc) sample[4] *= 0.5;
  const LinkageModel model = MakeLinkageModel(Reference());
  PeriodSlopes plain, projected;
  std::array<bool, kLanes> excluded{};
  excluded[4] = true;
  ComputePeriodSlopes(model, bench.Sampling(), in, &plain);
  ComputePeriodSlopesUnknownMmf(model, bench.Sampling(), in, excluded, &projected);
  for (int j : {3, 5}) {
    EXPECT_GT(std::abs(plain.phase[0].residual[j]), 0.8);
    EXPECT_NEAR(projected.phase[0].residual[j], 0, 2 * kModelError);
  }
}

TEST(PeriodSlopes, ExpectedSlopeOfAnOpenCoilIsTheHealthyOne) {
  Bench bench;
  DetectorSettings s;
  s.sampling = bench.Sampling();
  BearingDetector detector(MakeLinkageModel(Reference()), s);
  detector.Period(bench.Run());
  const SlopeBand healthy = detector.Band(1);
  EXPECT_NEAR(healthy.slope, healthy.expected, healthy.half_width);
  bench.lanes.Break(1, bench.x0, bench.y0);
  detector.Period(bench.Run());
  const SlopeBand open = detector.Band(1);
  EXPECT_NEAR(open.slope, 0, 1);
  EXPECT_GT(open.expected - open.slope, 2 * open.half_width);
}

// Behind a period of which nothing is known the linkages may be anywhere: that they moved is no
// fault.
TEST(BearingDetector, NothingIsComparedAcrossAnUnknownPeriod) {
  Bench bench;
  bench.noise = 0.004;
  bench.x0 = bench.y0 = 0;
  DetectorSettings s;
  s.sampling = bench.Sampling();
  BearingDetector detector(MakeLinkageModel(Reference()), s);
  const auto runs = [&](int periods, bool known) {
    for (int n = 0; n < periods; ++n) {
      MeasuredPeriod in = bench.Run();
      in.comparable = known;
      const DetectorAlarm alarm = detector.Period(in);
      EXPECT_FALSE(alarm.raised) << n;
      EXPECT_EQ(alarm.diagnosis.cls, FaultClass::kNone);
    }
  };
  runs(30, true);
  runs(4, false);
  Lane other;
  for (int j = 0; j < kLanes; ++j) other[j] = j % 3 == 0 ? 2.6 : 1.7;
  bench.lanes.Settle(other, bench.x0, bench.y0);
  runs(30, true);
}

// The onset of a diagnosis is the period in which the fault came, however long the examination
// took.
TEST(BearingDetector, TheOnsetIsThePeriodOfTheFault) {
  for (const double left : {0.0, 0.5, 0.8})
    for (const int coil : {0, 5}) {
      Bench bench;
      bench.noise = 0.004;
      bench.x0 = bench.y0 = 0;
      DetectorSettings s;
      s.sampling = bench.Sampling();
      BearingDetector detector(MakeLinkageModel(Reference()), s);
      for (int n = 0; n < 20; ++n) detector.Period(bench.Run());
      const double fault = bench.t;
      if (left > 0)
        bench.lanes.ShortTurns(coil, 1 - left, kInfinity, 0, 0);
      else
        bench.lanes.Break(coil, 0, 0);
      Diagnosis found;
      for (int n = 0; n < 14 && found.cls == FaultClass::kNone; ++n)
        found = detector.Period(bench.Run()).diagnosis;
      EXPECT_EQ(found.coil, coil) << left;
      EXPECT_EQ(found.cls, left > 0 ? FaultClass::kPartialShort : FaultClass::kOpen) << left;
      EXPECT_DOUBLE_EQ(found.onset, fault) << left << " " << coil;
      EXPECT_GT(found.time, fault + 1.9 * kT);
    }
}

// A coil that another detector flags although all its equations hold is examined as long as is
// allowed, then cleared.
TEST(BearingDetector, AFlagWithoutAFaultIsClearedAtTheEnd) {
  Bench bench;
  bench.noise = 0.004;
  bench.x0 = bench.y0 = 0;
  DetectorSettings s;
  s.sampling = bench.Sampling();
  BearingDetector detector(MakeLinkageModel(Reference()), s);
  for (int n = 0; n < 20; ++n) detector.PeriodWatchedBy(-1, bench.Run());
  const DetectorAlarm first = detector.PeriodWatchedBy(3, bench.Run());
  EXPECT_TRUE(first.raised);
  EXPECT_EQ(first.coil, 3);
  int cleared = 0;
  for (int n = 1; n <= 20; ++n) {
    const DetectorAlarm a = detector.PeriodWatchedBy(-1, bench.Run());
    EXPECT_EQ(a.diagnosis.cls, FaultClass::kNone) << n;
    if (!a.cleared) continue;
    ++cleared;
    EXPECT_EQ(n, 12);
  }
  EXPECT_EQ(cleared, 1);
}

TEST(PositionMonitor, FollowsAParabolaExactly) {
  PositionMonitor m(1, 1);
  const auto y = [](double t) { return 3e-5 - 0.1 * t + 40 * t * t; };
  for (int k = 0; k < 4; ++k) m.Read(k * 8e-5, {y(k * 8e-5)});
  EXPECT_NEAR(m.At(0, 3 * 8e-5 + 6e-5), y(3 * 8e-5 + 6e-5), 1e-15);
  EXPECT_FALSE(m.ready(1.0));  // old readings say nothing
}

// A shaft thrown back between two readings leaves the parabola by at most a step's change of path.
TEST(PositionMonitor, AnImpactIsNoFaultOfASensorWhenOneIsPossible) {
  const double v = 0.5, h = 8e-5;
  for (double hit : {0.1, 0.4, 0.8}) {
    PositionMonitor knows(1, 3e-5, 2e-7), innocent(1, 3e-5, 2e-7);
    double most = 0;
    for (int k = 0; k < 20; ++k) {
      const double t = (k - 10 - hit) * h, y = 2e-4 - v * std::abs(t);
      knows.Read(k * h, {y}, {k >= 10 ? 2 * v * h : 0.0});
      innocent.Read(k * h, {y});
      most = std::max(most, knows.Departure(0));
    }
    EXPECT_FALSE(knows.faulty(0)) << hit;
    EXPECT_TRUE(innocent.faulty(0)) << hit;
    EXPECT_LT(most, 2 * v * h);
    EXPECT_GT(most, 0.5 * v * h);
    EXPECT_EQ(knows.Departure(0), 0);  // forgotten after three readings that follow the parabola
  }
}

TEST(PositionMonitor, NamesAStuckAndAJumpingSensorOnce) {
  std::mt19937 g(2);
  std::normal_distribution<double> noise(0, 2e-7);
  PositionMonitor m(2, 3e-5);
  int first = -1;
  for (int k = 0; k < 300; ++k) {
    const double whirl = 1.2e-4 * std::cos(1257 * 8e-5 * k);
    m.Read(k * 8e-5, {whirl + noise(g), k < 200 ? 0.5 * whirl + noise(g) : 1e-5});
    const std::vector<int> faults = m.TakeNewFaults();
    if (!faults.empty() && first < 0) {
      first = k;
      EXPECT_THAT(faults, ::testing::ElementsAre(1));
    }
  }
  EXPECT_GE(first, 200);
  EXPECT_LE(first, 207);
  EXPECT_FALSE(m.faulty(0));
}

}  // namespace
}  // namespace ambrig
