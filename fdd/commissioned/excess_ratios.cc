#include "fdd/commissioned/excess_ratios.h"

#include <algorithm>
#include <cmath>

#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

namespace {

constexpr double kAlike = 0.3;         // of the largest |c|: as if by one cause
constexpr double kGrossBand = 0.1;     // of |c| beyond what is gross, against the windows'
constexpr double kNoiseOfGross = 4;    // sd of c: gross values that may be noise are no suspicion
constexpr double kPatternGrows = 3;    // over commissioning
constexpr double kLeastPattern = 0.1;  // that is doubted
// least band of c < 0: a reading that is low by less is no reason to give up a coil, and
// no turns are lost that way
constexpr double kLeastBelow = 0.08;
// of a winding of a thrust side: where its iron saturates, turns lost by the partner make
// its c negative
constexpr double kLeastBelowOnOneCore = 0.15;

constexpr long long kStart = 40;     // periods: what is wrong then has no instant
constexpr double kCalmBefore = 0.5;  // of what is gross: c before an instant

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
  // 1/b is the variance of c.
  const auto told = Below(kNoiseOfGross * kNoiseOfGross, size * size * b);
  Store(out.ratio->v, Only(gross & told, size * (1 / kGrossBand)));
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

/// The largest of the windows, and c of that window; coils apart keep their own.
AMBRIG_WIDE void JudgeWindows(const Lane* used, const Lane* band, const Lane& apart,
                              const Lane& level_now, double least_below, Lane* ratio,
                              Lane* standing_out, Lane* level) {
  const LaneVector zero;
  const auto counts = Load(apart.v) == zero;
  LaneVector most = Load(ratio->v), of_most = Load(standing_out->v);
  for (int w = 0; w < kExcessWindows; ++w) {
    const LaneVector c = Load(used[w].v), healthy = Load(band[w].v),
                     over = Only(counts,
                                 Abs(c) / Select(c < zero, Max(healthy, least_below), healthy));
    of_most = Select(most < over, c, of_most);
    most = Max(most, over);
  }
  Store(ratio->v, most);
  Store(standing_out->v, of_most);
  Store(level->v, Select(counts, Abs(Load(level_now.v)), Load(level->v)));
}

}  // namespace

ExcessRatios::ExcessRatios(const LinkageModel& nominal, const CommissionedBearing& learnt)
    : coils_(nominal.coils),
      relies_(learnt.usable()),
      pattern_limit_(std::max(kLeastPattern, kPatternGrows * learnt.pattern)),
      least_below_(nominal.coupling == Coupling::kSides ? kLeastBelowOnOneCore : kLeastBelow),
      windows_(nominal) {}

void ExcessRatios::Update(const SlopeExcess& excess, const Conditions& in) {
  const auto place = static_cast<std::size_t>(in.count % static_cast<long long>(recent_.size()));
  const PeriodLimits limits{ExcessLimits::kGross, in.gross_above, in.only_gross};
  bool gross = (whole_lanes ? JudgePeriodWhole : JudgePeriodInHalves)(
      excess, limits,
      {&recent_[place].top, &recent_[place].bottom, &now_, &ratio_, &level_, &apart_});
  FindSudden(in.count);
  if (relies_ && in.left && CountSudden(recent_[place].bottom)) gross = true;
  // What a model does not express keeps flux out in many coils: those are not the suspects.
  if (!relies_ && gross && GrossCoils() >= ExcessLimits::kCoilsAtOnce)
    for (int j = 0; j < coils_; ++j)
      if (now_[j] > 0) ratio_[j] = 0;
  windows_.Add(excess, apart_);
  calm_ = !gross && windows_.Calm(in.bands.of_windows(), kLevelWindow, pattern_limit_);
  if (!calm_) CompareWindows(in.bands);
  if (!relies_) FindJumps();
  last_now_[1] = last_now_[0];
  last_now_[0] = now_;
}

void ExcessRatios::CompareWindows(const ExcessBands& bands) {
  Lane used[kExcessWindows];
  windows_.UsedOfAll(ExcessLimits::kNoiseOfBand, used);
  standing_out_ = now_;
  JudgeWindows(used, bands.of_windows(), apart_, used[kLevelWindow], least_below_, &ratio_,
               &standing_out_, &level_);
}

void ExcessRatios::Skip(bool gross_before) {
  ratio_ = Lane{};
  if (!gross_before) return;
  for (Lane& c : last_now_) std::fill_n(c.v, kLanes, ExcessLimits::kGross);
}

void ExcessRatios::Restart() {
  windows_.Clear();
  ratio_ = Lane{};
}

void ExcessRatios::FindJumps() {
  for (int j = 0; j < kLanes; ++j) {
    if (now_[j] < ExcessLimits::kGross)
      jumped_[j] = 0;
    else if (now_[j] > ExcessLimits::kGrossAbove &&
             std::min(last_now_[0][j], last_now_[1][j]) < ExcessLimits::kGross)
      jumped_[j] = 1;
  }
}

void ExcessRatios::FindSudden(long long count) {
  for (int j = 0; j < kLanes; ++j) {
    if (now_[j] < ExcessLimits::kGross)
      sudden_[j] = 0;
    else if (count > kStart &&
             std::min(last_now_[0][j], last_now_[1][j]) < kCalmBefore * ExcessLimits::kGross)
      sudden_[j] = 1;
  }
}

bool ExcessRatios::CountSudden(const Lane& bottom) {
  bool any = false;
  for (int j = 0; j < coils_; ++j) {
    const bool told = now_[j] * now_[j] * bottom[j] > kNoiseOfGross * kNoiseOfGross;
    if (sudden_[j] == 0 || now_[j] < ExcessLimits::kGross || ratio_[j] > 0 || !told) continue;
    ratio_[j] = now_[j] / kGrossBand;
    level_[j] = now_[j];
    any = true;
  }
  return any;
}

double ExcessRatios::Recent(int coil) const {
  double top = 0, bottom = 0;
  for (const Sums& period : recent_) {
    top += period.top[coil];
    bottom += period.bottom[coil];
  }
  return bottom > kJudgedWeight ? top / bottom : 0;
}

double ExcessRatios::LargestNow() const {
  double most = 0;
  for (double c : now_.v) most = std::max(most, std::abs(c));
  return most;
}

int ExcessRatios::GrossCoils() const {
  int many = 0;
  for (double c : now_.v) many += c > ExcessLimits::kGross;
  return many;
}

bool ExcessRatios::Disturbed() const {
  if (calm_) return false;
  // A fault stands out from what it makes of its neighbours; the model's errors are alike.
  const double alike = kAlike * *std::max_element(level_.v, level_.v + kLanes);
  int beyond = 0;
  for (int j = 0; j < kLanes; ++j) beyond += ratio_[j] > 1 && level_[j] >= alike;
  return beyond >= ExcessLimits::kCoilsAtOnce || windows_.Pattern(kLevelWindow) > pattern_limit_;
}

}  // namespace ambrig
