#include "fdd/detectors/excess_windows.h"

#include <algorithm>
#include <cmath>

#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

namespace {

constexpr int kFewestForPattern = 4;  // coils
constexpr double kLeastShare = 0.3;   // of a coil's c left by the projection
constexpr double kSame = 1e-9;        // squared length of a direction that adds nothing

double Dot(const Lane& a, const Lane& b) {
  double sum = 0;
  for (int j = 0; j < kLanes; ++j) sum += a[j] * b[j];
  return sum;
}

AMBRIG_WIDE void AddPeriod(const SlopeExcess& p, const Lane& without, const Lane& last_top,
                           const Lane& last_bottom, Lane* top, Lane* bottom) {
  const LaneVector zero, gross = Load(without.v);
  const LaneVector a = Load(p.top[0].v) + Load(p.top[1].v),
                   b = Load(p.bottom[0].v) + Load(p.bottom[1].v);
  Store(top->v, Load(last_top.v) + Select(gross > zero, zero, a));
  Store(bottom->v, Load(last_bottom.v) + Select(gross > zero, zero, b));
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

AMBRIG_WIDE void Ratio(const Lane& top0, const Lane& bottom0, const Lane& top1, const Lane& bottom1,
                       Lane* c, Lane* bottom) {
  const WindowRatio<LaneVector> window(top0, bottom0, top1, bottom1);
  Store(bottom->v, window.bottom);
  Store(c->v, window.c);
}

struct Projection {
  const Lane* basis;
  int directions;
  const Lane* inverse_share;
};

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

AMBRIG_WIDE void UsedOfWindow(const Projection& p, const Lane& c, const Lane& bottom, double least,
                              Lane* used) {
  Store(used->v, Smaller(p, Load(c.v), Load(bottom.v), least));
}

/// Sums of top and bottom at the end, and before each of the windows that are full.
struct WindowSums {
  const Lane *top, *bottom;
  const Lane *top_before[kExcessWindows], *bottom_before[kExcessWindows];
  double least[kExcessWindows];  // weight that counts
  int full = 0;
};

template <class V>
[[gnu::always_inline]] inline void UsedOfWindows(const Projection& p, const WindowSums& s,
                                                 Lane* used) {
  for (int w = 0; w < s.full; ++w) {
    const WindowRatio<V> window(*s.top_before[w], *s.bottom_before[w], *s.top, *s.bottom);
    Store(used[w].v, Smaller(p, window.c, window.bottom, s.least[w]));
  }
}
AMBRIG_WHOLE void UsedWhole(const Projection& p, const WindowSums& s, Lane* used) {
  UsedOfWindows<WholeLaneVector>(p, s, used);
}
AMBRIG_WIDE void UsedInHalves(const Projection& p, const WindowSums& s, Lane* used) {
  UsedOfWindows<LaneVector>(p, s, used);
}

}  // namespace

ExcessWindows::ExcessWindows(const LinkageModel& nominal)
    : model_(nominal), total_(kRing), phases_(kRing) {
  for (int j = 0; j < model_.coils; ++j) judged_[j] = 1;
  Basis();
}

void ExcessWindows::Leave(int coil) {
  judged_[coil] = 0;
  Basis();
}

void ExcessWindows::Return(int coil) {
  judged_[coil] = 1;
  Basis();
}

void ExcessWindows::Basis() {
  directions_ = 0;
  inverse_share_ = Lane{};
  const double coils = Dot(judged_, judged_);
  if (coils < kFewestForPattern) return;
  const Lane wanted[3] = {judged_, model_.direction_x, model_.direction_y};
  for (const Lane& one : wanted) {
    Lane b;
    for (int j = 0; j < kLanes; ++j) b[j] = one[j] * judged_[j];
    for (int d = 0; d < directions_; ++d) {
      const double along = Dot(basis_[d], b);
      for (int j = 0; j < kLanes; ++j) b[j] -= along * basis_[d][j];
    }
    const double square = Dot(b, b);
    if (square < kSame) continue;
    double most = 0;
    for (double& v : b.v) {
      v /= std::sqrt(square);
      most = std::max(most, std::abs(v));
    }
    largest_[directions_] = most;
    basis_[directions_++] = b;
  }
  for (int j = 0; j < kLanes; ++j) {
    double share = judged_[j];
    for (int d = 0; d < directions_; ++d) share -= basis_[d][j] * basis_[d][j];
    inverse_share_[j] = share > kLeastShare ? 1 / share : 0;
  }
}

void ExcessWindows::Clear() {
  count_ = 0;
  std::fill(total_.begin(), total_.end(), Sums{});
  std::fill(phases_.begin(), phases_.end(), Phases{});
}

void ExcessWindows::Add(const SlopeExcess& period, const Lane& without) {
  const auto now = static_cast<std::size_t>(count_ % kRing);
  if (now == 0 && count_ > 0) {
    // Sums of all periods lose digits with time: they start anew at what has left every window.
    const Sums base = total_[kRing - kExcessWindow[kExcessWindows - 1] - 1];
    for (Sums& s : total_)
      for (int j = 0; j < kLanes; ++j) {
        s.top[j] -= base.top[j];
        s.bottom[j] -= base.bottom[j];
      }
  }
  static const Sums nothing;
  const Sums& last = count_ > 0 ? total_[(now + kRing - 1) % kRing] : nothing;
  AddPeriod(period, without, last.top, last.bottom, &total_[now].top, &total_[now].bottom);
  Phases& p = phases_[now];
  for (int q = 0; q < 2; ++q) {
    p.top[q] = period.top[q];
    p.bottom[q] = period.bottom[q];
  }
  ++count_;
}

const ExcessWindows::Sums& ExcessWindows::Before(int w) const {
  static const Sums nothing;
  const long long first = count_ - kExcessWindow[w];
  return first == 0 ? nothing : total_[static_cast<std::size_t>((first - 1) % kRing)];
}

void ExcessWindows::Window(int w, Lane* c, Lane* bottom) const {
  *c = *bottom = Lane{};
  if (count_ < kExcessWindow[w]) return;
  const Sums &before = Before(w), &last = Last();
  Ratio(before.top, before.bottom, last.top, last.bottom, c, bottom);
}

Lane ExcessWindows::Raw(int w) const {
  Lane c, bottom;
  Window(w, &c, &bottom);
  return c;
}

Lane ExcessWindows::Used(int w, double noisiest) const {
  Lane c, bottom, used;
  Window(w, &c, &bottom);
  UsedOfWindow({basis_, directions_, &inverse_share_}, c, bottom, 1 / (noisiest * noisiest), &used);
  return used;
}

void ExcessWindows::UsedOfAll(double below, Lane (&used)[kExcessWindows]) const {
  WindowSums sums{&Last().top, &Last().bottom, {}, {}, {}};
  for (int& w = sums.full; w < kExcessWindows && count_ >= kExcessWindow[w]; ++w) {
    sums.top_before[w] = &Before(w).top;
    sums.bottom_before[w] = &Before(w).bottom;
    const double noisiest = kExcessFloor[w] / below;
    sums.least[w] = 1 / (noisiest * noisiest);
  }
  (whole_lanes ? UsedWhole : UsedInHalves)({basis_, directions_, &inverse_share_}, sums, used);
  for (int w = sums.full; w < kExcessWindows; ++w) used[w] = Lane{};
}

double ExcessWindows::OfPhase(int coil, int phase, int periods) const {
  double top = 0, bottom = 0;
  for (long long n = std::max(0LL, count_ - periods); n < count_; ++n) {
    const Phases& p = phases_[static_cast<std::size_t>(n % kRing)];
    top += p.top[phase][coil];
    bottom += p.bottom[phase][coil];
  }
  return bottom > kJudgedWeight ? top / bottom : 0;
}

Lane ExcessWindows::Common(const Lane& c) const {
  Lane out;
  for (int d = 0; d < directions_; ++d) {
    const double along = Dot(basis_[d], c);
    for (int j = 0; j < kLanes; ++j) out[j] += along * basis_[d][j];
  }
  return out;
}

double ExcessWindows::Pattern(int w) const {
  const Lane c = Raw(w);
  double most = 0;
  for (int d = 0; d < directions_; ++d)
    most = std::max(most, std::abs(Dot(basis_[d], c)) * largest_[d]);
  return most;
}

}  // namespace ambrig
