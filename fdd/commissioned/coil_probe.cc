#include "fdd/commissioned/coil_probe.h"

#include <cmath>

#include "fdd/commissioned/excess_lanes.h"
#include "fdd/commissioned/excess_limits.h"
#include "fdd/commissioned/no_current.h"

namespace ambrig {

namespace {

constexpr double kIdle = 0.12;       // [A] a larger reading of a coil without current is false
constexpr int kCalmPeriods = 3;      // periods before anything counts
constexpr int kCurrentSettled = 15;  // periods until the current has come
constexpr int kLong = 35;            // periods of a probe: kSettledPeriods more
constexpr double kNoSlope = -0.7;    // c
constexpr double kLeastSeen = 4;     // of the sum of weights of a phase
constexpr double kPhaseBand = 2;     // of a single phase's |c|, over the band

}  // namespace

void CoilProbe::Begin(int coil, double idle, double band) {
  *this = CoilProbe();
  coil_ = coil;
  band_ = band;
  if (std::abs(idle) > kIdle) answer_ = ProbeAnswer::kFaulty;
}

void CoilProbe::Add(const SlopeExcess& e, double largest) {
  if (answer_ != ProbeAnswer::kNone) return;
  if (++periods_ <= kCalmPeriods) return;
  const double top = e.top[0][coil_] + e.top[1][coil_],
               bottom = e.bottom[0][coil_] + e.bottom[1][coil_];
  const bool without = bottom > 0 && top < kNoSlope * bottom;
  likelihood_ = without ? likelihood_ + LikelihoodOfNoCurrent(e, coil_) : 0;
  without_ = without ? without_ + 1 : 0;
  if (no_current()) answer_ = ProbeAnswer::kFaulty;
  if (periods_ <= kCurrentSettled) return;
  idle_ += largest < kIdle;
  for (int q = 0; q < 2; ++q) {
    top_[q] += e.top[q][coil_];
    bottom_[q] += e.bottom[q][coil_];
  }
  if (no_current()) answer_ = ProbeAnswer::kFaulty;
  if (periods_ < kLong || answer_ != ProbeAnswer::kNone) return;
  bool healthy = std::abs(top_[0] + top_[1]) < band_ * (bottom_[0] + bottom_[1]);
  for (int q = 0; q < 2; ++q)
    healthy =
        healthy && bottom_[q] > kLeastSeen && std::abs(top_[q]) < kPhaseBand * band_ * bottom_[q];
  answer_ = healthy ? ProbeAnswer::kHealthy : ProbeAnswer::kFaulty;
}

void CoilProbe::WatchOthers(const SlopeExcess& e) {
  for (int j = 0; j < kLanes; ++j) {
    const double top = e.top[0][j] + e.top[1][j], bottom = e.bottom[0][j] + e.bottom[1][j];
    const bool gross =
        j != coil_ && bottom > kJudgedWeight && std::abs(top) > ExcessLimits::kGross * bottom;
    calm_[j] = calm_[j] || !gross;
    gross_[j] = gross && calm_[j] ? gross_[j] + 1 : 0;
    if (gross_[j] >= kInARow && answer_ == ProbeAnswer::kNone) answer_ = ProbeAnswer::kInterrupted;
  }
}

bool CoilProbe::no_current() const {
  return (without_ >= kInARow && likelihood_ > kSurelyNoCurrent) || idle_ >= kSettledPeriods;
}

double CoilProbe::excess() const {
  const double bottom = bottom_[0] + bottom_[1];
  return bottom > 0 ? (top_[0] + top_[1]) / bottom : 0;
}

}  // namespace ambrig
