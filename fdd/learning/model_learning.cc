#include "fdd/learning/model_learning.h"

#include <algorithm>

#include "actuators/magnetics/lane_vector.h"

namespace ambrig {

namespace {

using V = LaneVector;
constexpr double kToleranceFactor = 3;  // tolerances count this many times
// of the tolerances: coils differ within a bearing
constexpr double kLeastLeakage = 0.2, kLeastLearntGap = 0.3;
constexpr double kMemory = 500, kSizeMemory = 200;  // periods
// |z| beyond says no more about the usual size
constexpr double kLargestSize = 4;

/// Normal equations of one period: matrix (00, 01, 11), right side.
struct LearningSums {
  double a00, a01, a11, b0, b1;
};

AMBRIG_WIDE LearningSums LearnFrom(const LinkageModel& m, const PeriodSlopes& slopes,
                                   double periods, ResidualChart* chart) {
  const V zero, leakage = Load(m.leakage.v);
  V a00, a01, a11, b0, b1;
  for (int q = 0; q < 2; ++q) {
    const PhaseSlopes& p = slopes.phase[q];
    const V size = Load(chart->size[q].v), per_sd = Load(chart->per_sd[q].v);
    const auto holds = Load(chart->valid[q].v) > zero;
    const V moved =
        size + (periods / kSizeMemory) * (Min(Abs(Load(chart->z[q].v)), kLargestSize) - size);
    Store(chart->size[q].v, Select(holds, moved, size));
    const V weight = Select(holds, periods * per_sd * per_sd, zero);
    const V di = Load(p.current.v), x0 = -di, x1 = Load(p.linkage.v) - leakage * di,
            e = Load(p.residual.v);
    a00 += weight * x0 * x0;
    a01 += weight * x0 * x1;
    a11 += weight * x1 * x1;
    b0 += weight * x0 * e;
    b1 += weight * x1 * e;
  }
  return {Sum(a00), Sum(a01), Sum(a11), Sum(b0), Sum(b1)};
}

}  // namespace

ModelLearning::ModelLearning(double leakage_sd, double gap_sd)
    : leakage_sd_(leakage_sd), gap_sd_(gap_sd) {
  Solve();
}

void ModelLearning::Learn(const LinkageModel& m, const PeriodSlopes& slopes, int periods,
                          ResidualChart* chart) {
  const LearningSums s = LearnFrom(m, slopes, periods, chart);
  const double forget = periods / kMemory;
  info_[0] += s.a00 - forget * info_[0];
  info_[1] += s.a01 - forget * info_[1];
  info_[2] += s.a11 - forget * info_[2];
  pull_[0] += s.b0 - forget * pull_[0];
  pull_[1] += s.b1 - forget * pull_[1];
  Solve();
}

void ModelLearning::Solve() {
  const double leak = 1 / (leakage_sd_ * leakage_sd_), gap = 1 / (gap_sd_ * gap_sd_);
  const double p0 = info_[0] + leak, p1 = info_[2] + gap;
  const double det = p0 * p1 - info_[1] * info_[1];
  known_.leakage =
      std::clamp((p1 * pull_[0] - info_[1] * pull_[1]) / det, -5 * leakage_sd_, 5 * leakage_sd_);
  known_.gap = std::clamp((p0 * pull_[1] - info_[1] * pull_[0]) / det, -5 * gap_sd_, 5 * gap_sd_);
  // Covariance of what is left.
  known_.uncertainty[0] =
      kToleranceFactor * kToleranceFactor * p1 / det + kLeastLeakage * kLeastLeakage / leak;
  known_.uncertainty[1] = -2 * kToleranceFactor * kToleranceFactor * info_[1] / det;
  known_.uncertainty[2] =
      kToleranceFactor * kToleranceFactor * p0 / det + kLeastLearntGap * kLeastLearntGap / gap;
}

}  // namespace ambrig
