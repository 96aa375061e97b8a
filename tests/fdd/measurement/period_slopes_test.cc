// Slopes of a period from sums in lanes, against lines fitted coil by coil from the definition.
#include "fdd/measurement/period_slopes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

constexpr double kStep = kT / kSamples;

ThrustStatorParameters Thrust() {
  ThrustStatorParameters p;
  p.turns = 60;
  p.pole_area = 6e-4;
  p.gap = 5e-4;
  p.leakage_inductance = 4e-4;
  p.resistance = 0.6;
  return p;
}

/// A period of currents that follow no law, with another duty in every coil, over a moving gap.
struct AnyPeriod {
  LinkageModel model;
  AmplifierParameters amplifier = Bridge();
  SamplingSettings sampling{kSamples, kStep, &amplifier};
  Lane adc[kSamples], duty;
  MeasuredPeriod in;

  explicit AnyPeriod(const LinkageModel& m) : model(m) {
    for (int j = 0; j < m.coils; ++j) {
      duty[j] = 0.25 + 0.06 * j;
      for (int k = 0; k < kSamples; ++k)
        adc[k][j] = 2 + 0.1 * j + 0.3 * Normal(5, 1, static_cast<std::uint64_t>(k * kLanes + j));
    }
    in.adc = adc;
    in.duty = &duty;
    in.bus = 30.5;
    in.x0 = 4e-5;
    in.y0 = -2e-5;
    in.x1 = 6e-5;
    in.y1 = -5e-5;
  }
  PeriodSlopes Slopes() const {
    PeriodSlopes out;
    ComputePeriodSlopes(model, sampling, in, &out);
    return out;
  }
  /// λ of coil j at sample k, by the equations of linkage_model.h.
  double Linkage(int j, int k) const {
    const Lane start = model.Permeance(in.x0, in.y0), end = model.Permeance(in.x1, in.y1);
    const auto P = [&](int c) { return start[c] + (end[c] - start[c]) * k / kSamples; };
    double mmf = model.n[j] * adc[k][j];
    if (model.coupling == Coupling::kSides) mmf += model.n[j ^ 1] * adc[k][j ^ 1];
    if (model.coupling == Coupling::kFloatingRotor) {
      double top = 0, sum = 0;
      for (int c = 0; c < model.coils; ++c) {
        top += P(c) * model.n[c] * adc[k][c];
        sum += P(c);
      }
      mmf -= top / sum;
    }
    return model.n[j] * P(j) * mmf + model.leakage[j] * adc[k][j];
  }
};

struct Line {
  double slope = 0, mean = 0, least = 1e30;
  int samples = 0;
};
template <class Of>
Line Fit(int from, int to, const Of& of) {
  Line line;
  line.samples = to - from;
  double top = 0, bottom = 0;
  for (int k = from; k < to; ++k) {
    const double away = k - 0.5 * (from + to - 1);
    top += away * of(k);
    bottom += away * away;
    line.mean += of(k) / line.samples;
    line.least = std::min(line.least, of(k));
  }
  line.slope = top / (bottom * kStep);
  return line;
}

class Bearings : public ::testing::TestWithParam<const char*> {
 protected:
  LinkageModel Model() const {
    return GetParam()[0] == 'r' ? MakeLinkageModel(Reference()) : MakeLinkageModel(Thrust());
  }
};

TEST_P(Bearings, AreTheLinesOfLeastSquares) {
  const AnyPeriod period(Model());
  const PeriodSlopes slopes = period.Slopes();
  for (int j = 0; j < period.model.coils; ++j) {
    // samples with k h <= edge
    const int edge = static_cast<int>(std::floor(period.duty[j] * kT / kStep)) + 1;
    for (int q = 0; q < 2; ++q) {
      const int from = q == 0 ? 0 : edge, to = q == 0 ? edge : kSamples;
      const Line linkage = Fit(from, to, [&](int k) { return period.Linkage(j, k); });
      const Line current = Fit(from, to, [&](int k) { return period.adc[k][j]; });
      const PhaseSlopes& p = slopes.phase[q];
      EXPECT_EQ(p.samples[j], linkage.samples) << j << ' ' << q;
      EXPECT_NEAR(p.linkage[j], linkage.slope, 1e-9 * std::abs(linkage.slope) + 1e-7)
          << j << ' ' << q;
      EXPECT_NEAR(p.current[j], current.slope, 1e-9 * std::abs(current.slope) + 1e-4)
          << j << ' ' << q;
      EXPECT_NEAR(p.mean[j], current.mean, 1e-12) << j << ' ' << q;
      const double voltage = q == 0 ? 30.5 - 0.25 : -30.5 - 1.4;
      EXPECT_NEAR(p.residual[j],
                  linkage.slope + period.model.resistance[j] * current.mean - voltage, 1e-6)
          << j << ' ' << q;
    }
    EXPECT_NEAR(slopes.first[j], period.Linkage(j, 0), 1e-15) << j;
    EXPECT_NEAR(slopes.last[j], period.Linkage(j, kSamples - 1), 1e-15) << j;
  }
}

// Whether diodes may block: each phase's own least sample where a coil is near zero, in either
// phase.
TEST_P(Bearings, LeastSampleOfEachPhaseWhereItMatters) {
  AnyPeriod period(Model());
  for (int low : {-1, 2, kSamples - 1}) {
    if (low >= 0) period.adc[low][1] = 0.2 * kZeroCurrent;
    const PeriodSlopes slopes = period.Slopes();
    for (int j = 0; j < period.model.coils; ++j) {
      const auto edge = static_cast<int>(slopes.phase[0].samples[j]);
      const auto of = [&](int k) { return period.adc[k][j]; };
      const double on = Fit(0, edge, of).least, off = Fit(edge, kSamples, of).least;
      EXPECT_EQ(slopes.phase[0].least[j], low < 0 ? std::min(on, off) : on) << j << ' ' << low;
      EXPECT_EQ(slopes.phase[1].least[j], low < 0 ? std::min(on, off) : off) << j << ' ' << low;
    }
    EXPECT_EQ(std::min(slopes.phase[0].least[1], slopes.phase[1].least[1]) < kZeroCurrent, low >= 0)
        << low;
    if (low >= 0) period.adc[low][1] = 2;
  }
}

INSTANTIATE_TEST_SUITE_P(PeriodSlopes, Bearings, ::testing::Values("radial", "thrust"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace ambrig
