#include "fdd/commissioned/excess_lanes.h"

#include <algorithm>
#include <cmath>

#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

namespace {

constexpr double kSurely = 0.999;  // of a limit: rounding makes no difference

template <class V>
[[gnu::always_inline]] inline void AddPeriod(const SlopeExcess& p, const Lane& without,
                                             const Lane& last_top, const Lane& last_bottom,
                                             Lane* top, Lane* bottom) {
  const auto left_out = Below(0.0, LoadAs<V>(without.v));
  const V a = LoadAs<V>(p.top[0].v) + LoadAs<V>(p.top[1].v),
          b = LoadAs<V>(p.bottom[0].v) + LoadAs<V>(p.bottom[1].v);
  Store(top->v, LoadAs<V>(last_top.v) + Only(~left_out, a));
  Store(bottom->v, LoadAs<V>(last_bottom.v) + Only(~left_out, b));
}
AMBRIG_WHOLE void AddPeriodWhole(const SlopeExcess& p, const Lane& without, const Lane& last_top,
                                 const Lane& last_bottom, Lane* top, Lane* bottom) {
  AddPeriod<WholeLaneVector>(p, without, last_top, last_bottom, top, bottom);
}
AMBRIG_WIDE void AddPeriodInHalves(const SlopeExcess& p, const Lane& without, const Lane& last_top,
                                   const Lane& last_bottom, Lane* top, Lane* bottom) {
  AddPeriod<LaneVector>(p, without, last_top, last_bottom, top, bottom);
}

/// Raw c of a window and its weight.
template <class V>
struct WindowRatio {
  V c, bottom;
  [[gnu::always_inline]] WindowRatio(const Lane& top0, const Lane& bottom0, const Lane& top1,
                                     const Lane& bottom1)
      : bottom(LoadAs<V>(bottom1.v) - LoadAs<V>(bottom0.v)) {
    const auto enough = Below(kJudgedWeight, bottom);
    c = Only(enough, (LoadAs<V>(top1.v) - LoadAs<V>(top0.v)) / Choose(enough, bottom, 1));
  }
};

AMBRIG_WIDE void RatioOfHalves(const Lane& top0, const Lane& bottom0, const Lane& top1,
                               const Lane& bottom1, Lane* c, Lane* bottom) {
  const WindowRatio<LaneVector> window(top0, bottom0, top1, bottom1);
  Store(bottom->v, window.bottom);
  Store(c->v, window.c);
}

template <class V>
[[gnu::always_inline]] inline V Smaller(const Projection& p, const V& c, const V& bottom,
                                        double least) {
  const V zero = 0.0, inverse = LoadAs<V>(p.inverse_share->v);
  V left = c;
  for (int d = 0; d < p.directions; ++d) {
    const V b = LoadAs<V>(p.basis[d].v);
    left = left - b * Sum(b * c);
  }
  left = Choose(Below(zero, inverse), left * inverse, c);
  const V smaller = Choose(Below(Abs(left), Abs(c)), left, c);
  return Only(Below(zero, left * c) & ~Below(bottom, least), smaller);
}

AMBRIG_WIDE void UsedOfHalves(const Projection& p, const Lane& c, const Lane& bottom, double least,
                              Lane* used) {
  Store(used->v, Smaller(p, Load(c.v), Load(bottom.v), least));
}

template <class V>
[[gnu::always_inline]] inline void UsedOfAll(const Projection& p, const WindowSums& s,
                                             const double* least, Lane* used) {
  for (int w = 0; w < s.full; ++w) {
    const WindowRatio<V> window(*s.top_before[w], *s.bottom_before[w], *s.top, *s.bottom);
    Store(used[w].v, Smaller(p, window.c, window.bottom, least[w]));
  }
}
AMBRIG_WHOLE void UsedWhole(const Projection& p, const WindowSums& s, const double* least,
                            Lane* used) {
  UsedOfAll<WholeLaneVector>(p, s, least, used);
}
AMBRIG_WIDE void UsedInHalves(const Projection& p, const WindowSums& s, const double* least,
                              Lane* used) {
  UsedOfAll<LaneVector>(p, s, least, used);
}

template <class V>
[[gnu::always_inline]] inline bool CalmOver(const Projection& p, const WindowSums& s,
                                            const CalmLimits& limits) {
  V most = 0.0;
  for (int w = 0; w < s.full; ++w) {
    const V top = LoadAs<V>(s.top->v) - LoadAs<V>(s.top_before[w]->v),
            bottom = LoadAs<V>(s.bottom->v) - LoadAs<V>(s.bottom_before[w]->v);
    most = Max(Abs(top) - bottom * LoadAs<V>(limits.band[w].v) * kSurely, most);
  }
  if (Largest(most) > 0) return false;
  if (s.full <= limits.window) return true;
  const WindowRatio<V> window(*s.top_before[limits.window], *s.bottom_before[limits.window], *s.top,
                              *s.bottom);
  double pattern = 0;
  for (int d = 0; d < p.directions; ++d) {
    const double along = Sum(LoadAs<V>(p.basis[d].v) * window.c) * limits.largest[d];
    pattern = std::max(pattern, std::abs(along));
  }
  return pattern <= kSurely * limits.pattern;
}
AMBRIG_WHOLE bool CalmWhole(const Projection& p, const WindowSums& s, const CalmLimits& limits) {
  return CalmOver<WholeLaneVector>(p, s, limits);
}
AMBRIG_WIDE bool CalmInHalves(const Projection& p, const WindowSums& s, const CalmLimits& limits) {
  return CalmOver<LaneVector>(p, s, limits);
}

}  // namespace

void AddPeriodTo(const SlopeExcess& period, const Lane& without, const Lane& last_top,
                 const Lane& last_bottom, Lane* top, Lane* bottom) {
  (whole_lanes ? AddPeriodWhole : AddPeriodInHalves)(period, without, last_top, last_bottom, top,
                                                     bottom);
}

void RawOfWindow(const Lane& top0, const Lane& bottom0, const Lane& top1, const Lane& bottom1,
                 Lane* c, Lane* bottom) {
  RatioOfHalves(top0, bottom0, top1, bottom1, c, bottom);
}

void UsedOfWindow(const Projection& p, const Lane& c, const Lane& bottom, double least,
                  Lane* used) {
  UsedOfHalves(p, c, bottom, least, used);
}

void UsedOfWindows(const Projection& p, const WindowSums& s, const double* least, Lane* used) {
  (whole_lanes ? UsedWhole : UsedInHalves)(p, s, least, used);
}

bool AllBelow(const Projection& p, const WindowSums& s, const CalmLimits& limits) {
  return (whole_lanes ? CalmWhole : CalmInHalves)(p, s, limits);
}

}  // namespace ambrig
