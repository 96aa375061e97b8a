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

AMBRIG_WIDE void Ratio(const Lane& top0, const Lane& bottom0, const Lane& top1, const Lane& bottom1,
                       Lane* c, Lane* bottom) {
  const LaneVector zero, b = Load(bottom1.v) - Load(bottom0.v), some = Select(b > 0.5, b, 1);
  Store(bottom->v, b);
  Store(c->v, Select(b > 0.5, (Load(top1.v) - Load(top0.v)) / some, zero));
}

struct Projection {
  const Lane* basis;
  int directions;
  const Lane *inverse_share, *bottom;
  double least;  // of the sum below, else too noisy
};

AMBRIG_WIDE void Smaller(const Projection& p, const Lane& raw, Lane* used) {
  const LaneVector zero, c = Load(raw.v), inverse = Load(p.inverse_share->v);
  LaneVector left = c;
  for (int d = 0; d < p.directions; ++d) {
    const LaneVector b = Load(p.basis[d].v);
    left = left - b * Sum(b * c);
  }
  left = Select(inverse > zero, left * inverse, c);
  const LaneVector smaller = Select(Abs(left) < Abs(c), left, c);
  const LaneVector agreed = Select(left * c > zero, smaller, zero);
  Store(used->v, Select(Load(p.bottom->v) < p.least, zero, agreed));
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
    for (double& v : b.v) v /= std::sqrt(square);
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

void ExcessWindows::Window(int w, Lane* c, Lane* bottom) const {
  *c = *bottom = Lane{};
  const int periods = kExcessWindow[w];
  if (count_ < periods) return;
  static const Sums nothing;
  const auto now = static_cast<std::size_t>((count_ - 1) % kRing);
  const Sums& before = count_ == periods
                           ? nothing
                           : total_[(now + kRing - static_cast<std::size_t>(periods)) % kRing];
  Ratio(before.top, before.bottom, total_[now].top, total_[now].bottom, c, bottom);
}

Lane ExcessWindows::Raw(int w) const {
  Lane c, bottom;
  Window(w, &c, &bottom);
  return c;
}

Lane ExcessWindows::Used(int w, double noisiest) const {
  Lane c, bottom, used;
  Window(w, &c, &bottom);
  Smaller({basis_, directions_, &inverse_share_, &bottom, 1 / (noisiest * noisiest)}, c, &used);
  return used;
}

double ExcessWindows::OfPhase(int coil, int phase, int periods) const {
  double top = 0, bottom = 0;
  for (long long n = std::max(0LL, count_ - periods); n < count_; ++n) {
    const Phases& p = phases_[static_cast<std::size_t>(n % kRing)];
    top += p.top[phase][coil];
    bottom += p.bottom[phase][coil];
  }
  return bottom > 0.5 ? top / bottom : 0;
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
  for (int d = 0; d < directions_; ++d) {
    double scale = 0;
    for (double v : basis_[d].v) scale = std::max(scale, std::abs(v));
    most = std::max(most, std::abs(Dot(basis_[d], c)) * scale);
  }
  return most;
}

}  // namespace ambrig
