/// Ratios of the commissioned detector: how far every coil stands beyond what is healthy.
#include <algorithm>
#include <cmath>

#include "actuators/magnetics/whole_lane_vector.h"
#include "fdd/detectors/commissioned_detector.h"

namespace ambrig {

namespace {

constexpr double kGrossBand = 0.1;     // of |c| beyond what is gross, against the windows'
constexpr double kPatternGrows = 3;    // over commissioning
constexpr double kLeastPattern = 0.1;  // that is doubted
// least band of c < 0: a reading that is low by less is no reason to give up a coil, and no turns are
// lost that way
constexpr double kLeastBelow = 0.08;
// of a winding of a thrust side: where its iron saturates, turns lost by the partner make its c negative
constexpr double kLeastBelowOnOneCore = 0.15;

struct PeriodLimits {
  double gross;        // of |c|
  Lane above;          // of c > 0
  bool apart = false;  // all coils: only gross values count in this period
};

/// What one period says by itself.
struct PeriodSays {
  Lane *top, *bottom, *now, *ratio, *level, *apart;
};

/// Returns whether any coil is gross.
template <class V>
[[gnu::always_inline]] inline bool JudgeOnePeriod(const SlopeExcess& e, const PeriodLimits& limits,
                                                  const PeriodSays& out) {
  const V zero = 0.0, one = 1.0;
  const V a = LoadAs<V>(e.top[0].v) + LoadAs<V>(e.top[1].v),
          b = LoadAs<V>(e.bottom[0].v) + LoadAs<V>(e.bottom[1].v);
  const auto seen = Below(kJudgedWeight, b);
  const V c = Only(seen, a / Choose(seen, b, one)), size = Abs(c);
  const auto gross = Below(Choose(Below(zero, c), LoadAs<V>(limits.above.v), limits.gross), size);
  const V level = Only(gross, size);
  Store(out.top->v, a);
  Store(out.bottom->v, b);
  Store(out.now->v, c);
  Store(out.ratio->v, Only(gross, size * (1 / kGrossBand)));
  Store(out.level->v, level);
  // What a fault throws at its neighbours in its first period would stay in their windows.
  const V starts_at_zero = Only(Below(zero, LoadAs<V>(e.gross.v)), one);
  Store(out.apart->v, limits.apart ? one : Max(Only(gross, one), starts_at_zero));
  return Largest(level) > 0;
}
AMBRIG_WHOLE bool JudgePeriodWhole(const SlopeExcess& e, const PeriodLimits& limits,
                                   const PeriodSays& out) {
  return JudgeOnePeriod<WholeLaneVector>(e, limits, out);
}
AMBRIG_WIDE bool JudgePeriodInHalves(const SlopeExcess& e, const PeriodLimits& limits,
                                     const PeriodSays& out) {
  return JudgeOnePeriod<LaneVector>(e, limits, out);
}

/// The largest of the windows; coils apart keep their own.
AMBRIG_WIDE void JudgeWindows(const Lane* used, const Lane* band, const Lane& apart,
                              const Lane& level_now, double least_below, Lane* ratio, Lane* level) {
  const LaneVector zero;
  const auto counts = Load(apart.v) == zero;
  LaneVector most = Load(ratio->v);
  for (int w = 0; w < kExcessWindows; ++w) {
    const LaneVector c = Load(used[w].v), healthy = Load(band[w].v);
    most = Max(most, Only(counts, Abs(c) / Select(c < zero, Max(healthy, least_below), healthy)));
  }
  Store(ratio->v, most);
  Store(level->v, Select(counts, Abs(Load(level_now.v)), Load(level->v)));
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

void CommissionedDetector::WatchJumps() {
  for (int j = 0; j < kLanes; ++j) {
    if (now_[j] < kGross)
      jumped_[j] = 0;
    else if (now_[j] > kGrossAbove && std::min(last_now_[0][j], last_now_[1][j]) < kGross)
      jumped_[j] = 1;
  }
  last_now_[1] = last_now_[0];
  last_now_[0] = now_;
}

double CommissionedDetector::PatternLimit() const {
  return std::max(kLeastPattern, kPatternGrows * model_.pattern);
}

void CommissionedDetector::Ratios() {
  const auto place = static_cast<std::size_t>(count_ % static_cast<long long>(kInARow));
  const PeriodLimits limits{kGross, gross_above_, touching_ || out_of_range_};
  const bool gross = (whole_lanes ? JudgePeriodWhole : JudgePeriodInHalves)(
      excess_, limits,
      {&recent_[place].top, &recent_[place].bottom, &now_, &ratio_, &level_, &apart_});
  // What a model does not express keeps flux out in many coils: those are not the suspects.
  if (!Relies() && gross && GrossCoils() >= kCoilsAtOnce)
    for (int j = 0; j < filter_.nominal().coils; ++j)
      if (now_[j] > 0) ratio_[j] = 0;
  windows_.Add(excess_, apart_);
  calm_ = !gross && windows_.Calm(band_, kLevelWindow, PatternLimit());
  if (!calm_) RatiosOfWindows();
}

void CommissionedDetector::RatiosOfWindows() {
  Lane used[kExcessWindows];
  windows_.UsedOfAll(kNoiseOfBand, used);
  const double least_below =
      filter_.nominal().coupling == Coupling::kSides ? kLeastBelowOnOneCore : kLeastBelow;
  JudgeWindows(used, band_, apart_, used[kLevelWindow], least_below, &ratio_, &level_);
}

}  // namespace ambrig
