/// What the commissioned detector compares with: its bands, the turns that coils have left, and slow
/// drift.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "fdd/detectors/commissioned_detector.h"
#include "fdd/model/loss_excess.h"

namespace ambrig {

namespace {

// without commissioning, beside the floors: what effects of usual size do to nominal models
constexpr double kUncommissioned[kExcessWindows] = {1.2, 0.9, 0.7, 0.6, 0.6};
constexpr double kLeastMiss = 0.3;  // [A] of a set-point
// bands and set-points missed, once coils were given up or lost turns
constexpr double kWider = 2.5;
constexpr double kLeastWeaker = 0.25;    // of them, where a coil has fewer turns than it had
constexpr double kGreatLoss = 0.3;       // of the turns: from there all of both
constexpr int kDriftEvery = 40;          // periods
constexpr int kDriftWindows[] = {3, 4};  // 40 and 160 periods
constexpr double kCalmShare = 0.5;       // of the bands
constexpr double kMostFirstDrift = 1.5;  // of the band of the window looked at, when it starts

}  // namespace

bool CommissionedDetector::SharesCore(int coil, int other) const {
  return filter_.nominal().coupling == Coupling::kSides && coil / 2 == other / 2;
}

double CommissionedDetector::LossOf(int coil) const {
  return std::min(1.0, (1 - share_[coil]) / kGreatLoss);
}

double CommissionedDetector::LeastBand(int coil, int window) const {
  // Errors of the share that a coil is believed to have left are in the c of all others, and most of all in those of a
  // winding on the same core.
  double least = 0;
  for (int j = 0; j < filter_.nominal().coils; ++j)
    if (share_[j] > 0)
      least = std::max(least,
                       LossOf(j) * (SharesCore(coil, j) ? kUncommissioned[window] : kLeastWeaker));
  return least;
}

void CommissionedDetector::SetBands() {
  for (int j = 0; j < kLanes; ++j) {
    const double of_loss = ExcessOfLoss(filter_.nominal(), j).own;
    for (int w = 0; w < kExcessWindows; ++w)
      band_[w][j] = model_.learnt
                        ? std::max(LeastBand(j, w), wider_ * HealthyBand(model_, w, j, of_loss))
                        : kUncommissioned[w];
  }
  for (int j = 0; j < kLanes; ++j)
    most_missed_[j] = wider_ * std::max(kLeastMiss, kBandOverHealthy * model_.current_error[j]);
}

void CommissionedDetector::SetTurns(int coil, double share) {
  if (share == 0) windows_.Leave(coil);
  TakeShare(coil, share);
}

void CommissionedDetector::Restore(int coil, double share) {
  windows_.Return(coil);
  TakeShare(coil, share);
}

void CommissionedDetector::TakeShare(int coil, double share) {
  share_[coil] = share;
  share_taken_[coil] = count_;
  filter_.SetTurns(coil, share);
  windows_.Clear();
  SetWider();
  SetBands();
  Pause(25);
}

void CommissionedDetector::SetWider() {
  wider_ = erred_ ? kWider : 1;
  for (int j = 0; j < filter_.nominal().coils; ++j)
    wider_ = std::max(wider_, 1 + (kWider - 1) * LossOf(j));
}

bool CommissionedDetector::TakesFirstDrift() {
  if (first_drifts_ == std::size(kDriftWindows) || !follows_drift_ || !Relies()) return false;
  steady_ = touching_ || out_of_range_ || wider_ > 1 ? 0 : steady_ + 1;
  const int window = kDriftWindows[first_drifts_];
  if (std::min(steady_, windows_.count()) < kExcessWindow[window]) return false;
  ++first_drifts_;
  for (int w = 0; w <= window; ++w) {
    const Lane c = windows_.Used(w, kExcessFloor[w] / kNoiseOfBand);
    const double most = w == window ? kMostFirstDrift : 1;
    for (int j = 0; j < filter_.nominal().coils; ++j)
      if (std::abs(c[j]) > most * band_[w][j]) return false;
  }
  const Lane c = windows_.Raw(window);
  drift_.Follow(c, windows_.Common(c), SlowDrift::kTimeConstant);
  windows_.Clear();
  ratio_ = streak_ = Lane{};
  return true;
}

void CommissionedDetector::FollowDrift(bool doubtful) {
  if (!follows_drift_ || count_ % kDriftEvery != 0 || doubtful || touching_ || wider_ > 1) return;
  for (const int w : kDriftWindows) {
    const Lane c = windows_.Used(w, kExcessFloor[w] / kNoiseOfBand);
    for (int j = 0; j < filter_.nominal().coils; ++j)
      if (std::abs(c[j]) > kCalmShare * band_[w][j]) return;
  }
  const Lane c = windows_.Raw(kDriftWindows[1]);
  drift_.Follow(c, windows_.Common(c), kDriftEvery * sampling_.samples * sampling_.step);
}

}  // namespace ambrig
