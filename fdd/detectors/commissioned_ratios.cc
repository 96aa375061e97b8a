/// Ratios of the commissioned detector: how far every coil stands beyond what is healthy.
#include <algorithm>
#include <cmath>

#include "actuators/magnetics/whole_lane_vector.h"
#include "fdd/detectors/commissioned_detector.h"

namespace ambrig {

namespace {

constexpr double kGrossBand = 0.1;  // of |c| beyond what is gross, against the windows'
constexpr int kLevelWindow = 2;     // over which coils are compared: ten periods
// least band of c < 0: a reading that is low by less is no reason to give up a coil, and no turns are
// lost that way
constexpr double kLeastBelow = 0.08;

struct PeriodLimits {
  double gross;        // of |c|
  Lane above;          // of c > 0
  bool apart = false;  // all coils: only gross values count in this period
};

/// What one period says by itself.
AMBRIG_WIDE void JudgePeriod(const SlopeExcess& e, const PeriodLimits& limits, Lane* top,
                             Lane* bottom, Lane* now, Lane* ratio, Lane* level, Lane* apart) {
  const LaneVector zero, one = 1.0;
  const LaneVector a = Load(e.top[0].v) + Load(e.top[1].v),
                   b = Load(e.bottom[0].v) + Load(e.bottom[1].v);
  const auto seen = Below(kJudgedWeight, b);
  const LaneVector c = Only(seen, a / Select(seen, b, one)), size = Abs(c);
  const auto gross = Below(Select(c > zero, Load(limits.above.v), limits.gross), size);
  Store(top->v, a);
  Store(bottom->v, b);
  Store(now->v, c);
  Store(ratio->v, Only(gross, size * (1 / kGrossBand)));
  Store(level->v, Only(gross, size));
  // What a fault throws at its neighbours in its first period would stay in their windows.
  const LaneVector starts_at_zero = Select(Load(e.gross.v) > zero, one, zero);
  Store(apart->v, limits.apart ? one : Select(gross, one, starts_at_zero));
}

/// The largest of the windows; coils apart keep their own.
AMBRIG_WIDE void JudgeWindows(const Lane* used, const Lane* band, const Lane& apart, Lane* ratio,
                              Lane* level) {
  const LaneVector zero;
  const auto counts = Load(apart.v) == zero;
  LaneVector most = Load(ratio->v);
  for (int w = 0; w < kExcessWindows; ++w) {
    const LaneVector c = Load(used[w].v), healthy = Load(band[w].v);
    most = Max(most, Only(counts, Abs(c) / Select(c < zero, Max(healthy, kLeastBelow), healthy)));
  }
  Store(ratio->v, most);
  Store(level->v, Select(counts, Abs(Load(used[kLevelWindow].v)), Load(level->v)));
}

/// Readings of every coil: the mean, and how far it and the one before both are from the set-point, of which
/// the amplifier gives nothing below `least`.
AMBRIG_WIDE void CompareCurrents(const Lane* adc, int samples, const Lane& set_point, double least,
                                 const Lane& limit, Lane* last_miss, Lane* error,
                                 Lane* false_current) {
  LaneVector mean = 0.0;
  for (int k = 0; k < samples; ++k) mean += Load(adc[k].v);
  const LaneVector miss = Abs(Max(Load(set_point.v), least) - mean * (1.0 / samples));
  Store(error->v, Min(miss, Load(last_miss->v)));
  Store(last_miss->v, miss);
  Store(false_current->v,
        Only(Below(Load(limit.v), miss), Load(false_current->v) + LaneVector(1.0)));
}

}  // namespace

void CommissionedDetector::WatchCurrents(const MeasuredPeriod& in) {
  current_error_ = Lane{};
  for (int j = 0; j < filter_.nominal().coils; ++j) {
    if (share_[j] > 0) continue;
    idle_[j] = 0;
    for (int k = 0; k < sampling_.samples; ++k) idle_[j] += in.adc[k][j] / sampling_.samples;
  }
  const double least = sampling_.amplifier->quadrants > 2 ? -kInfinity : 0;
  if (in.set_point)
    CompareCurrents(in.adc, sampling_.samples, *in.set_point, least, most_missed_, &last_miss_,
                    &current_error_, &false_current_);
}

int CommissionedDetector::Ratios() {
  const int coils = filter_.nominal().coils;
  const auto place = static_cast<std::size_t>(count_ % static_cast<long long>(kInARow));
  const PeriodLimits limits{kGross, gross_above_, touching_ || out_of_range_};
  JudgePeriod(excess_, limits, &recent_[place].top, &recent_[place].bottom, &now_, &ratio_, &level_,
              &apart_);
  // What a model does not express keeps flux out in many coils: those are not the suspects.
  if (!Relies() && GrossCoils() >= kCoilsAtOnce)
    for (int j = 0; j < coils; ++j)
      if (now_[j] > 0) ratio_[j] = 0;
  windows_.Add(excess_, apart_);
  Lane used[kExcessWindows];
  windows_.UsedOfAll(kNoiseOfBand, used);
  JudgeWindows(used, band_, apart_, &ratio_, &level_);
  return static_cast<int>(std::max_element(ratio_.v, ratio_.v + coils) - ratio_.v);
}

}  // namespace ambrig
