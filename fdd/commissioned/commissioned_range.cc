#include "fdd/commissioned/commissioned_range.h"

#include <algorithm>

#include "fdd/commissioned/excess_lanes.h"
#include "fdd/commissioned/excess_limits.h"

namespace ambrig {

namespace {

constexpr double kMostWider = 1.25, kSpare = 1.02;  // of the commissioned range of flux
constexpr int kWiderPeriods = 250;
constexpr double kSudden = 0.15;  // c of one period, as a coil leaves its range
// the same over the largest c that healthy running made of one period
constexpr double kOverHealthy = 2;

}  // namespace

CommissionedRange::CommissionedRange(const LinkageModel& nominal, const CommissionedBearing& learnt)
    : coils_(nominal.coils), learnt_(learnt.learnt), largest_flux_(learnt.largest_flux) {
  for (int j = 0; j < kLanes; ++j)
    sudden_[j] = std::max(kSudden, kOverHealthy * learnt.largest[0][j]);
}

void CommissionedRange::Update(const FluxPeriod& flux, const SlopeExcess& excess,
                               const JumpWatch& jumps, const BelievedTurns& turns,
                               long long count) {
  const auto flux_jumps = [&](int j) {
    const double top = excess.top[0][j] + excess.top[1][j],
                 bottom = excess.bottom[0][j] + excess.bottom[1][j];
    return top > sudden_[j] * std::max(bottom, kJudgedWeight) || jumps.jump(j) > 0;
  };
  Lane beyond;
  int many = 0;
  for (int j = 0; j < coils_ && learnt_; ++j) {
    const double now = flux.largest_flux[j];
    if (turns.share[j] > 0 && now > largest_flux_[j]) {
      beyond[j] = Leaves(j, now, flux_jumps(j), count);
      many += beyond[j] > 0;
    }
  }
  last_flux_ = flux.largest_flux;
  left_ = many > 0;
  // Iron that takes less flux than its model leaves the rest to all other poles: from two of eight
  // their c is a third at most.
  for (int j = 0; j < kLanes; ++j)
    gross_above_[j] = many == 0 ? ExcessLimits::kGross
                      : beyond[j] > 0 || many >= ExcessLimits::kCoilsAtOnce
                          ? ExcessLimits::kGrossAbove
                          : ExcessLimits::kGrossBeside;
}

bool CommissionedRange::Leaves(int coil, double flux, bool jumps, long long count) {
  const double range = largest_flux_[coil];
  if (last_flux_[coil] > 0 && last_flux_[coil] <= range && jumps) {
    wider_[coil] = range * std::min(kMostWider, kSpare * flux / last_flux_[coil]);
    wider_until_[coil] = count + kWiderPeriods;
  }
  return count > wider_until_[coil] || flux > wider_[coil];
}

}  // namespace ambrig
