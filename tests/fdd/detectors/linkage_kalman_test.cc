// The Kalman filter's innovations on its own model: white, of the size it says, chi-square; and on
// the simulator's stator.
#include "fdd/detectors/linkage_kalman.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

/// λ(k+1) = λ + ∫v dt - R i h + w, y = L^-1 λ + e: what the filter assumes, off-centre.
class FilterModel {
 public:
  FilterModel(const CoilDetectorSetup& setup, double process_sd)
      : s_(setup),
        process_sd_(process_sd),
        L_(InductanceOf(setup.model, setup.model.Permeance(kX, kY))),
        C_(L_.inverse()) {
    lambda_ = L_ * LinkageVector::Constant(2.0);
    for (double& d : duty.v) d = 0.522;
  }
  MeasuredPeriod Run() {
    float w[kSamples * kLanes], e[kSamples * kLanes];
    FillNormals(21, 1, period_, w, kSamples * kLanes);
    FillNormals(21, 2, period_, e, kSamples * kLanes);
    const SamplingSettings& s = s_.settings.sampling;
    MeasuredPeriod in;
    for (int k = 0; k < kSamples; ++k) {
      const LinkageVector i = C_ * lambda_;
      for (int j = 0; j < kLanes; ++j) {
        const int at = k * kLanes + j;
        adc[k][j] = i[j] + s_.settings.current_noise * static_cast<double>(e[at]);
        const BridgeVoltage v = VoltageOf(*s.amplifier, duty[j], 30);
        const double on = std::clamp(v.edge - k * s.step, 0.0, s.step);
        lambda_[j] += on * v.on + (s.step - on) * v.off - s.step * s_.model.resistance[j] * i[j] +
                      process_sd_ * static_cast<double>(w[at]);
      }
    }
    applied = duty;
    // Duties that hold the currents, as a current loop does.
    for (int j = 0; j < kLanes; ++j) duty[j] = 0.522 + 0.01 * (2 - adc[0][j]);
    in.adc = adc;
    in.duty = &applied;
    in.bus = 30;
    in.x0 = in.x1 = kX;
    in.y0 = in.y1 = kY;
    ++period_;
    return in;
  }
  Lane duty, applied, adc[kSamples];

 private:
  static constexpr double kX = 1e-4, kY = -0.5e-4;
  CoilDetectorSetup s_;
  double process_sd_;
  LinkageMatrix L_, C_;
  LinkageVector lambda_;
  std::uint64_t period_ = 0;
};

TEST(LinkageKalman, InductanceIsThatOfTheStator) {
  const RadialStator stator(Reference());
  const LinkageMatrix L = InductanceOf(MakeLinkageModel(Reference()),
                                       MakeLinkageModel(Reference()).Permeance(1e-4, 2e-5));
  EXPECT_LT((L - stator.Inductance({1e-4, 2e-5})).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(LinkageKalman, InnovationsAreWhiteAndOfTheirSize) {
  Bench bench;
  CoilDetectorSetup setup = SetupOf(bench);
  LinkageKalman filter(setup);
  FilterModel model(setup, filter.process_sd());
  std::vector<double> nu[kLanes];
  for (int n = 0; n < 1200; ++n) {
    filter.Period(model.Run());
    for (int j = 0; n >= 200 && j < kLanes; ++j)
      for (int k = 0; k < kSamples; ++k) nu[j].push_back(filter.innovation(k, j));
  }
  for (const auto& x : nu) {
    const auto n = static_cast<double>(x.size());
    double mean = 0, variance = 0;
    for (double v : x) mean += v / n;
    for (double v : x) variance += v * v / n;
    EXPECT_NEAR(mean, 0, 4 / std::sqrt(n));
    // 1 %: explicit R i, constant gain in a period
    EXPECT_NEAR(variance, 1, 4 * std::sqrt(2 / n) + 0.01);
    for (std::size_t lag : {1u, 2u, 5u, 18u}) {
      double r = 0;
      for (std::size_t k = 0; k + lag < x.size(); ++k) r += x[k] * x[k + lag] / n;
      EXPECT_NEAR(r, 0, 4 / std::sqrt(n)) << "lag " << lag;
    }
  }
}

TEST(LinkageKalman, FalseAlarmsAreThoseOfChiSquare) {
  Bench bench;
  CoilDetectorSetup setup = SetupOf(bench);
  LinkageKalman filter(setup);
  FilterModel model(setup, filter.process_sd());
  // Upper quantiles of chi-square with 18 degrees of freedom (tables): 25.989 at 10 %, 34.805 at 1
  // %.
  const double quantile[] = {25.989, 34.805}, p[] = {0.1, 0.01};
  double over[2] = {0, 0}, count = 0;
  for (int n = 0; n < 3000; ++n) {
    const Lane s = filter.Period(model.Run());
    for (int j = 0; n >= 200 && j < kLanes; ++j) {
      count += 1;
      for (int q = 0; q < 2; ++q) over[q] += s[j] * kSamples > quantile[q] ? 1 : 0;
    }
  }
  for (int q = 0; q < 2; ++q)
    EXPECT_NEAR(over[q] / count, p[q], 4 * std::sqrt(p[q] / count) + 0.05 * p[q]) << q;
}

TEST(LinkageKalman, FollowsTheSimulatorsStatorMovingAndNamesTheBrokenCoil) {
  Bench bench;
  bench.noise = 0.004;
  bench.vx = 0.1;  // whirl at 60 % of the clearance, 8000 rpm
  LinkageKalman filter(SetupOf(bench));
  for (int n = 0; n < 20; ++n)
    for (double s : filter.Period(bench.Run()).v) EXPECT_LT(s, 3.5);  // chi-square over 18: 1e-6
  bench.lanes.Break(6, bench.x0, bench.y0);
  const Lane s = filter.Period(bench.Run());
  EXPECT_EQ(std::max_element(s.v, s.v + kLanes) - s.v, 6);
  EXPECT_GT(s[6], 100);
}

TEST(LinkageKalman, ACoilHeldAtZeroByItsDiodesIsHealthy) {
  Bench bench;
  bench.noise = 0.004;
  bench.duty[1] = 0.02;  // told zero: the bridge is off but for a moment
  LinkageKalman filter(SetupOf(bench));
  for (int n = 0; n < 60; ++n) {
    const Lane s = filter.Period(bench.Run());
    for (int j = 0; j < kLanes; ++j) EXPECT_LT(s[j], 6) << n << " " << j;
  }
}

}  // namespace
}  // namespace ambrig
