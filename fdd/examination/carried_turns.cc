#include "fdd/examination/carried_turns.h"

#include <algorithm>
#include <cmath>

#include "core/base/parameters.h"

namespace ambrig {

namespace {

constexpr long long kBetweenMarks = 128, kFewestSinceMark = 64;  // periods
constexpr double kNode[3] = {1, 0.7, 0.4};                       // shares of the circuits that run
constexpr double kFewest = 0.35, kShareStep = 0.05;              // of the turns
constexpr double kUntried = 0.5 * kShareStep;  // to the middle between two shares of the grid
constexpr double kLag[] = {0, 5e-4, 1e-3, 2e-3, 4e-3, 8e-3, 16e-3, 32e-3};  // [s]
constexpr long long kFirstTold = 16, kTellEvery = 8;                        // periods
constexpr double kLongest = 60e-3;  // [s] afterwards the error of the bridge counts more
constexpr double kAsGood = 0.004, kWrong = 0.03;  // of the linkage before: rms of the balance
constexpr double kOfBest = 0.6;                   // of the least rms: no worse than that
constexpr double kLeastMove = 0.04;               // of the turns
constexpr double kMayBlock = 0.04;                // [A] a reading of zero within its noise

/// Parabola through the circuits that run.
double Between(const double* at, double share) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double a = kNode[(k + 1) % 3], b = kNode[(k + 2) % 3];
    sum += at[k] * (share - a) * (share - b) / ((kNode[k] - a) * (kNode[k] - b));
  }
  return sum;
}

}  // namespace

CarriedTurns::CarriedTurns(const FluxFilter& filter, const SamplingSettings& sampling,
                           const CoilEquations& coils)
    : whole_(filter), sampling_(sampling), coils_(coils), node_{filter, filter, filter} {}

void CarriedTurns::Clear() {
  count_ = 0;
  coil_ = -1;
  moved_ = false;
  mark_ = {};
  volts_ = charge_ = Lane{};
}

Lane CarriedTurns::FluxOf(const Row& row, FluxFilter* filter) const {
  std::array<Lane, 64> still;
  std::fill_n(still.begin(), sampling_.samples, row.mean);
  MeasuredPeriod in = row.in;
  in.adc = still.data();
  in.duty = &row.duty;
  FluxPeriod flux;
  filter->Period(in, &flux);
  for (int j = 0; j < kLanes; ++j)
    if (whole_.nominal().n[j] < 0) flux.flux[j] = -flux.flux[j];
  return flux.flux;
}

CarriedTurns::Mark CarriedTurns::MarkAt(const Row& row, long long count) const {
  Mark out{count, row.volts, row.charge, {}};
  FluxFilter still = whole_;
  const Lane flux = FluxOf(row, &still);
  for (int j = 0; j < kLanes; ++j)
    out.linkage[j] =
        coils_.gain[j] * whole_.inductances()[j] * flux[j] + coils_.leakage[j] * row.mean[j];
  return out;
}

void CarriedTurns::Keep(const MeasuredPeriod& in, const FluxPeriod& flux, const Lane& mean) {
  const AmplifierParameters& amplifier = *sampling_.amplifier;
  const double period = sampling_.step * sampling_.samples;
  moved_ = false;
  Lane edge;
  if (amplifier.modulation == Modulation::kBiState)
    for (int j = 0; j < kLanes; ++j) edge[j] = (*in.duty)[j] * period;
  else
    for (int j = 0; j < whole_.nominal().coils; ++j)
      edge[j] = VoltageOf(amplifier, (*in.duty)[j], in.bus).edge;
  const Lane &on = flux.phase[0].voltage, &off = flux.phase[1].voltage;
  for (int j = 0; j < kLanes; ++j) {
    volts_[j] += on[j] * edge[j] + off[j] * (period - edge[j]);
    charge_[j] += mean[j] * period;
  }
  Row& row = row_[static_cast<std::size_t>(count_++ % kKept)];
  row = {in, *in.duty, mean, flux.least_on, volts_, charge_};
  if (coil_ >= 0) {
    Follow(row);
    if (followed_ >= kFirstTold && followed_ % kTellEvery == 0) Tell();
  } else if (count_ % kBetweenMarks == 0) {
    mark_[static_cast<std::size_t>(count_ / kBetweenMarks % kMarks)] = MarkAt(row, count_);
  }
}

void CarriedTurns::Begin(int coil, double onset, double share, double least) {
  const double period = sampling_.step * sampling_.samples;
  const long long oldest = std::max(0LL, count_ - kKept);
  const auto kept = [&](long long p) -> const Row& {
    return row_[static_cast<std::size_t>(p % kKept)];
  };
  long long last = count_ - 1;
  while (last > oldest && kept(last).in.t + 1.5 * period > onset - 0.5 * period) --last;
  const Mark* before = nullptr;
  for (const Mark& m : mark_)
    if (m.count > 0 && m.count + kFewestSinceMark <= last && (!before || m.count < before->count))
      before = &m;
  if (last <= oldest || !before) return;
  start_ = kept(last);
  const Mark now = MarkAt(start_, last + 1);
  coil_ = coil;
  share_ = share;
  told_ = false;
  least_ = std::max(least - kShareStep, kFewest);
  followed_ = 0;
  offset_ = (now.volts[coil] - before->volts[coil] -
             coils_.resistance[coil] * (now.charge[coil] - before->charge[coil]) -
             (now.linkage[coil] - before->linkage[coil])) /
            static_cast<double>(now.count - before->count);
  linkage_ = std::abs(now.linkage[coil]);
  FluxFilter reference = whole_;
  for (long long p = oldest; p <= last; ++p) flux_ = FluxOf(kept(p), &reference)[coil];
  for (int k = 0; k < kNodes; ++k) {
    node_[static_cast<std::size_t>(k)] = reference;
    node_[static_cast<std::size_t>(k)].SetTurns(coil, kNode[k]);
  }
  std::fill_n(&lagging_[0][0], kShares * kLags, flux_);
  std::fill_n(&error_[0][0], kShares * kLags, 0.0);
  for (long long p = last + 1; p < count_ && running(); ++p) Follow(kept(p));
  followed_ = 0;
}

void CarriedTurns::TurnsChange() {
  if (followed_ > 0) coil_ = -1;
  mark_ = {};
}

void CarriedTurns::Follow(const Row& row) {
  if (row.least[coil_] < kMayBlock && sampling_.amplifier->quadrants <= 2) {
    coil_ = -1;
    return;
  }
  ++followed_;
  const double period = sampling_.step * sampling_.samples;
  const double main = coils_.gain[coil_] * whole_.inductances()[coil_];
  const double since = std::round((row.in.t - start_.in.t) / period);
  const double driven = row.volts[coil_] - start_.volts[coil_] - offset_ * since;
  const double drop = coils_.resistance[coil_] * (row.charge[coil_] - start_.charge[coil_]);
  const double leaks = coils_.leakage[coil_] * (row.mean[coil_] - start_.mean[coil_]);
  double at[kNodes];
  for (std::size_t k = 0; k < kNodes; ++k) at[k] = FluxOf(row, &node_[k])[coil_];
  for (int s = 0; s < kShares; ++s) {
    const double share = kFewest + kShareStep * s, flux = Between(at, share);
    for (int lag = 0; lag < kLags; ++lag) {
      double& now = lagging_[s][lag];
      now += (flux - now) * (kLag[lag] > 0 ? -std::expm1(-period / kLag[lag]) : 1);
      const double rest = share * (drop + main * (now - flux_)) + share * share * leaks - driven;
      error_[s][lag] += rest * rest;
    }
  }
  if (row.in.t - start_.in.t > kLongest) coil_ = -1;
}

void CarriedTurns::Tell() {
  if (coil_ < 0) return;
  const auto least_of = [&](int s) {
    return kFewest + kShareStep * s < least_ ? kInfinity
                                             : *std::min_element(error_[s], error_[s] + kLags);
  };
  double best = kInfinity;
  for (int s = 0; s < kShares; ++s) best = std::min(best, least_of(s));
  const double n = static_cast<double>(followed_), wrong = kWrong * linkage_,
               as_good = std::max(kAsGood * linkage_, kOfBest * std::sqrt(best / n));
  if (best > n * wrong * wrong) return;
  double low = kInfinity, high = 0;
  for (int s = 0; s < kShares; ++s) {
    if (least_of(s) > best + n * as_good * as_good) continue;
    low = std::min(low, kFewest + kShareStep * s);
    high = kFewest + kShareStep * s;
  }
  const double least = low - kUntried, most = std::min(1.0, high + kUntried);
  // Turns that were taken for bypassed are in a loop, of which the least loss is counted on.
  const double share = share_ < least && !told_ ? high : std::clamp(share_, least, most);
  if (std::abs(share - share_) < kLeastMove) return;
  share_ = share;
  moved_ = told_ = true;
}

}  // namespace ambrig
