#include "fdd/commissioned/excess_bands.h"

#include <algorithm>

#include "fdd/model/loss_excess.h"

namespace ambrig {

namespace {

// without commissioning, beside the floors: what effects of usual size do to nominal models
constexpr double kUncommissioned[kExcessWindows] = {1.2, 0.9, 0.7, 0.6, 0.6};
constexpr double kLeastMiss = 0.3;  // [A] of a set-point
// bands and set-points missed, once coils were given up or lost turns
constexpr double kWider = 2.5;
constexpr double kLeastWeaker = 0.25;  // of them, where a coil has fewer turns than it had
constexpr double kGreatLoss = 0.3;     // of the turns: from there all of both

}  // namespace

ExcessBands::ExcessBands(const LinkageModel& nominal, const CommissionedBearing& learnt)
    : nominal_(nominal) {
  BelievedTurns healthy;
  for (int j = 0; j < nominal.coils; ++j) healthy.share[j] = 1;
  Set(learnt, healthy);
}

double ExcessBands::LossOf(double share) { return std::min(1.0, (1 - share) / kGreatLoss); }

double ExcessBands::LeastBand(int coil, int window, const Lane& share) const {
  // Errors of the share that a coil is believed to have left are in the c of all others,
  // and most of all in those of a winding on the same core.
  double least = 0;
  for (int j = 0; j < nominal_.coils; ++j)
    if (share[j] > 0)
      least = std::max(
          least, LossOf(share[j]) *
                     (SharesCore(nominal_, coil, j) ? kUncommissioned[window] : kLeastWeaker));
  return least;
}

void ExcessBands::Set(const CommissionedBearing& learnt, const BelievedTurns& turns) {
  wider_ = turns.erred ? kWider : 1;
  for (int j = 0; j < nominal_.coils; ++j)
    wider_ = std::max(wider_, 1 + (kWider - 1) * LossOf(turns.share[j]));
  for (int j = 0; j < kLanes; ++j) {
    const double of_loss = ExcessOfLoss(nominal_, j).own;
    for (int w = 0; w < kExcessWindows; ++w)
      band_[w][j] = learnt.learnt ? std::max(LeastBand(j, w, turns.share),
                                             wider_ * HealthyBand(learnt, w, j, of_loss))
                                  : kUncommissioned[w];
  }
  for (int j = 0; j < kLanes; ++j)
    most_missed_[j] = wider_ * std::max(kLeastMiss, kBandOverHealthy * learnt.current_error[j]);
}

}  // namespace ambrig
