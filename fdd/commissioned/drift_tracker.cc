#include "fdd/commissioned/drift_tracker.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "fdd/commissioned/excess_limits.h"

namespace ambrig {

namespace {

constexpr int kDriftEvery = 40;          // periods
constexpr int kDriftWindows[] = {3, 4};  // 40 and 160 periods
constexpr double kCalmShare = 0.5;       // of the bands
constexpr double kMostFirstDrift = 1.5;  // of the band of the window looked at, when it starts

}  // namespace

DriftTracker::DriftTracker(const LinkageModel& nominal, const SamplingSettings& sampling,
                           bool relies)
    : coils_(nominal.coils),
      relies_(relies),
      interval_(kDriftEvery * sampling.samples * sampling.step) {}

bool DriftTracker::Within(double most, int w, const ExcessWindows& windows,
                          const ExcessBands& bands) const {
  const Lane c = windows.Used(w, kExcessFloor[w] / ExcessLimits::kNoiseOfBand);
  for (int j = 0; j < coils_; ++j)
    if (std::abs(c[j]) > most * bands.band(w, j)) return false;
  return true;
}

bool DriftTracker::TakesFirst(bool undisturbed, const ExcessWindows& windows,
                              const ExcessBands& bands) {
  if (first_drifts_ == std::size(kDriftWindows) || !follows_ || !relies_) return false;
  steady_ = undisturbed ? steady_ + 1 : 0;
  const int window = kDriftWindows[first_drifts_];
  if (std::min(steady_, windows.count()) < kExcessWindow[window]) return false;
  ++first_drifts_;
  for (int w = 0; w <= window; ++w)
    if (!Within(w == window ? kMostFirstDrift : 1, w, windows, bands)) return false;
  const Lane c = windows.Raw(window);
  drift_.Follow(c, windows.Common(c), SlowDrift::kTimeConstant);
  return true;
}

void DriftTracker::Follow(long long count, const ExcessWindows& windows, const ExcessBands& bands) {
  if (!follows_ || count % kDriftEvery != 0 || bands.widened()) return;
  for (const int w : kDriftWindows)
    if (!Within(kCalmShare, w, windows, bands)) return;
  const Lane c = windows.Raw(kDriftWindows[1]);
  drift_.Follow(c, windows.Common(c), interval_);
}

}  // namespace ambrig
