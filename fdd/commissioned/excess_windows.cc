#include "fdd/commissioned/excess_windows.h"

#include <algorithm>
#include <cmath>

#include "fdd/model/loss_excess.h"

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

void ExcessWindows::TakeSense(bool taken) {
  sense_ = taken;
  Basis();
}

void ExcessWindows::AddDirection(const Lane& direction) {
  Lane b;
  for (int j = 0; j < kLanes; ++j) b[j] = direction[j] * judged_[j];
  for (int d = 0; d < directions_; ++d) {
    const double along = Dot(basis_[d], b);
    for (int j = 0; j < kLanes; ++j) b[j] -= along * basis_[d][j];
  }
  const double square = Dot(b, b);
  if (square < kSame) return;
  double most = 0;
  for (double& v : b.v) {
    v /= std::sqrt(square);
    most = std::max(most, std::abs(v));
  }
  largest_[directions_] = most;
  basis_[directions_++] = b;
}

double ExcessWindows::ShareLeft(int coil) const {
  double share = judged_[coil];
  for (int d = 0; d < directions_; ++d) share -= basis_[d][coil] * basis_[d][coil];
  const LossExcess loss = ExcessOfLoss(model_, coil);
  if (loss.partner > 0 && judged_[coil ^ 1] > 0)
    for (int d = 0; d < directions_; ++d)
      share -= loss.partner / loss.own * basis_[d][coil] * basis_[d][coil ^ 1];
  return share;
}

void ExcessWindows::Basis() {
  directions_ = 0;
  inverse_share_ = Lane{};
  const double coils = Dot(judged_, judged_);
  if (coils < kFewestForPattern) return;
  AddDirection(judged_);
  AddDirection(model_.direction_x);
  AddDirection(model_.direction_y);
  if (sense_) {
    Lane sense;
    for (int j = 0; j < model_.coils; ++j) sense[j] = model_.n[j] < 0 ? -1 : 1;
    const int without = directions_;
    AddDirection(sense);
    // With so few coils left it would take their faults off, too.
    for (int j = 0; j < model_.coils; ++j)
      if (judged_[j] > 0 && ShareLeft(j) <= kLeastShare) directions_ = without;
  }
  for (int j = 0; j < kLanes; ++j) {
    const double share = ShareLeft(j);
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
  AddPeriodTo(period, without, last.top, last.bottom, &total_[now].top, &total_[now].bottom);
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
  RawOfWindow(before.top, before.bottom, last.top, last.bottom, c, bottom);
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

WindowSums ExcessWindows::FullWindows() const {
  WindowSums sums{&Last().top, &Last().bottom, {}, {}, 0};
  for (int& w = sums.full; w < kExcessWindows && count_ >= kExcessWindow[w]; ++w) {
    sums.top_before[w] = &Before(w).top;
    sums.bottom_before[w] = &Before(w).bottom;
  }
  return sums;
}

void ExcessWindows::UsedOfAll(double below, Lane (&used)[kExcessWindows]) const {
  const WindowSums sums = FullWindows();
  double least[kExcessWindows];
  for (int w = 0; w < kExcessWindows; ++w) {
    const double noisiest = kExcessFloor[w] / below;
    least[w] = 1 / (noisiest * noisiest);
  }
  UsedOfWindows({basis_, directions_, &inverse_share_}, sums, least, used);
  for (int w = sums.full; w < kExcessWindows; ++w) used[w] = Lane{};
}

bool ExcessWindows::Calm(const Lane (&band)[kExcessWindows], int w, double pattern) const {
  return AllBelow({basis_, directions_, &inverse_share_}, FullWindows(),
                  {band, largest_, w, pattern});
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
