#include "fdd/commissioned/coil_currents.h"

#include <algorithm>

#include "actuators/magnetics/whole_lane_vector.h"
#include "core/base/parameters.h"
#include "fdd/commissioned/excess_limits.h"
#include "fdd/commissioned/no_current.h"

namespace ambrig {

namespace {

constexpr int kMissedTwice = 2;      // periods in a row
constexpr double kDeadIdle = 0.75;   // -c of a coil without current that is asked for none
constexpr double kAsked = 0.24;      // [A] set-point from which a coil is asked for current
constexpr double kRangeOfNoise = 8;  // sd: of the readings of a winding whose current does not move
constexpr double kStill = 0.25;      // of the range of its partner's

/// Readings of every coil: the mean, and how far it and the one before both are from
/// the set-point, of which the amplifier gives nothing below `least`.
AMBRIG_WIDE void CompareCurrents(const Lane* adc, int samples, const Lane& set_point, double least,
                                 const Lane& limit, Lane* mean_out, Lane* last_miss, Lane* error,
                                 Lane* false_current) {
  LaneVector mean = 0.0;
  for (int k = 0; k < samples; ++k) mean += Load(adc[k].v);
  mean = mean * (1.0 / samples);
  Store(mean_out->v, mean);
  const LaneVector miss = Abs(Max(Load(set_point.v), least) - mean);
  Store(error->v, Min(miss, Load(last_miss->v)));
  Store(last_miss->v, miss);
  Store(false_current->v,
        Only(Below(Load(limit.v), miss), Load(false_current->v) + LaneVector(1.0)));
}

}  // namespace

CoilCurrents::CoilCurrents(const LinkageModel& nominal, const SamplingSettings& sampling,
                           double noise)
    : coils_(nominal.coils),
      samples_(sampling.samples),
      thrust_(nominal.coupling == Coupling::kSides),
      noise_(noise),
      least_(sampling.amplifier->quadrants > 2 ? -kInfinity : 0) {}

void CoilCurrents::Update(const MeasuredPeriod& in, const Lane& share, const Lane& most_missed) {
  error_ = Lane{};
  for (int j = 0; j < coils_; ++j) {
    if (share[j] > 0) continue;
    idle_[j] = 0;
    for (int k = 0; k < samples_; ++k) idle_[j] += in.adc[k][j] / samples_;
  }
  if (in.set_point)
    CompareCurrents(in.adc, samples_, *in.set_point, least_, most_missed, &mean_, &last_miss_,
                    &error_, &false_);
}

bool CoilCurrents::IsFalse(int coil) const { return false_[coil] >= kMissedTwice; }

bool CoilCurrents::IsMissing(int coil) const {
  return without_[coil] >= ExcessLimits::kInARow && likelihood_[coil] > kSurelyNoCurrent;
}

bool CoilCurrents::AnySuspect() const {
  for (int j = 0; j < coils_; ++j)
    if (false_[j] > 0 || without_[j] > 0) return true;
  return false;
}

bool CoilCurrents::LeftToPartner(const MeasuredPeriod& in, int coil, const Lane& share) const {
  const int partner = coil ^ 1;
  if (!thrust_ || !in.set_point || share[coil] == 0 || share[partner] == 0 ||
      (*in.set_point)[coil] < kAsked || false_[coil] == 0 || (*in.duty)[coil] < (*in.duty)[partner])
    return false;
  const auto range = [&](int j) {
    double least = in.adc[0][j], most = least;
    for (int k = 1; k < samples_; ++k) {
      least = std::min(least, in.adc[k][j]);
      most = std::max(most, in.adc[k][j]);
    }
    return most - least;
  };
  const double own = range(coil);
  return own < kRangeOfNoise * noise_ && own < kStill * range(partner);
}

void CoilCurrents::CountWithout(const MeasuredPeriod& in, const FluxPeriod& flux,
                                const SlopeExcess& excess, const Lane& c, const Lane& share) {
  for (int j = 0; j < coils_; ++j) {
    // The diodes of a coil that is asked for no current block: its flux stands, whatever the bridge
    // does.
    const bool asked = !in.set_point || (*in.set_point)[j] > kAsked;
    const bool left_to_partner = LeftToPartner(in, j, share);
    const bool dead =
        (flux.largest[j] < kConducts && c[j] < -(asked ? ExcessLimits::kGross : kDeadIdle)) ||
        left_to_partner;
    if (without_[j] == 0) {
      since_[j] = in.t;
      likelihood_[j] = 0;
    }
    without_[j] = dead ? without_[j] + 1 : 0;
    if (dead)
      likelihood_[j] += left_to_partner ? kSurelyNoCurrent : LikelihoodOfNoCurrent(excess, j);
  }
}

}  // namespace ambrig
