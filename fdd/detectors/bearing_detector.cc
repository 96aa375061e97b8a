#include "fdd/detectors/bearing_detector.h"

#include <algorithm>
#include <cmath>

#include "fdd/measurement/motion_uncertainty.h"

namespace ambrig {

namespace {
constexpr double kCalm = 1.5;        // no suspicion while every G is below
constexpr double kCalmResidual = 4;  // and in a pause, while every residual is [sd]
// what the voltage may err by within one sample [sd of its mean over a phase]
constexpr double kStepVoltage = 5;
// periods after which a coil that is off carries nothing: 1 ms, 0.2 ms are needed
constexpr int kDecayed = 25;
// [A] what a coil of unknown MMF may carry beside its reading
constexpr double kLeastUnknownCurrent = 1;
constexpr int kLearnEvery = 4;  // periods
}  // namespace

BearingDetector::BearingDetector(const LinkageModel& model, const DetectorSettings& settings)
    : model_(model), s_(settings), learning_(settings.leakage_sd, settings.gap_sd), ring_(kRing) {
  for (Lane& size : chart_.size)
    for (int j = 0; j < kLanes; ++j) size[j] = 0.8;  // mean of |z| of a normal variable
  for (int j = 0; j < model_.coils; ++j) watched_[j] = 1;
  const Lane P = model_.Permeance(0, 0);
  centred_ = *std::max_element(P.v, P.v + kLanes);
}

void BearingDetector::Keep(const MeasuredPeriod& in) {
  ring_[static_cast<std::size_t>(count_ % kRing)].Keep(in, s_.sampling.samples);
  ++count_;
}

void BearingDetector::MaskFaultyCurrentReadings() {
  KeptPeriod& kept = ring_[static_cast<std::size_t>((count_ - 1) % kRing)];
  for (int j = 0; j < kLanes; ++j) off_for_[j] = kept.duty[j] <= 0 ? off_for_[j] + 1 : 0;
  if (!any_false_reading_) return;
  for (int j = 0; j < model_.coils; ++j) {
    const auto lane = static_cast<std::size_t>(j);
    if (!false_reading_[lane] || off_for_[j] < kDecayed) continue;
    for (int k = 0; k < s_.sampling.samples; ++k) kept.adc[static_cast<std::size_t>(k)][j] = 0;
    if (!unknown_mmf_[lane]) continue;
    unknown_mmf_[lane] = false;
    state_[lane] = Coil::kLost;
    if (model_.coupling == Coupling::kSides && state_[lane ^ 1] == Coil::kUnknownMmf &&
        !unknown_mmf_[lane ^ 1]) {
      state_[lane ^ 1] = Coil::kHealthy;
      watched_[j ^ 1] = 1;
    }
    any_unknown_ = std::any_of(unknown_mmf_.begin(), unknown_mmf_.end(), [](bool b) { return b; });
    paused_ = std::max(paused_, 1);
  }
}

double BearingDetector::UnknownPotential() const {
  double uncertainty = 0;
  for (int k = 0; any_unknown_ && k < model_.coils; ++k)
    if (unknown_mmf_[static_cast<std::size_t>(k)])
      uncertainty += std::abs(model_.n[k]) * slopes_.permeance.middle[k] *
                     std::max(slopes_.largest[k], kLeastUnknownCurrent);
  return uncertainty / slopes_.permeance.total;
}

void BearingDetector::Residuals(const MeasuredPeriod& in) {
  if (any_unknown_ && model_.coupling == Coupling::kFloatingRotor)
    ComputePeriodSlopesUnknownMmf(model_, s_.sampling, in, unknown_mmf_, &slopes_);
  else
    ComputePeriodSlopes(model_, s_.sampling, in, &slopes_);
  // What an unknown MMF was at the first sample stays unknown: the motion turns it into a voltage.
  const double potential_rate = UnknownPotential() / (s_.sampling.step * s_.sampling.samples);
  if (!in.uncertainty.any())
    return chart_.Compute(model_, s_.sampling, s_, learning_.known(), slopes_, watched_, nullptr,
                          potential_rate);
  Lane uncertainty[2];
  ResidualUncertainty(model_, slopes_, in.uncertainty, uncertainty);
  chart_.Compute(model_, s_.sampling, s_, learning_.known(), slopes_, watched_, uncertainty,
                 potential_rate);
}

int BearingDetector::StepBetweenPeriods(const Lane& last_linkage, const Lane& last_voltage,
                                        const MeasuredPeriod& in) {
  const double h = s_.sampling.step;
  const double noise = 1.4 * s_.current_noise / h, floor = kStepVoltage * s_.voltage_sd;
  if (!chart_.Steps({&last_linkage, &slopes_.first, &last_voltage, 1 / h, noise, floor}, s_.cap))
    return -1;
  const bool radial = model_.coupling == Coupling::kFloatingRotor;
  int largest = -1;
  double most = s_.cap;
  // A new reading moves the position at once.
  const Lane uncertainty = LinkageUncertainty(model_, slopes_, in.uncertainty.position);
  for (int j = 0; j < model_.coils; ++j) {
    const double step =
        std::abs((slopes_.first[j] - last_linkage[j]) / h - last_voltage[j]) - uncertainty[j] / h;
    if (step < s_.cap || (!Holds(0, j) && !Holds(1, j)) || in.adc[0][j] < kZeroCurrent) continue;
    const double own =
        model_.SelfInductance(j, slopes_.permeance.middle, radial ? slopes_.permeance.total : 1);
    const double sd = noise * own + floor;
    if (step < most * sd) continue;
    most = step / sd;
    largest = j;
  }
  return largest;
}

BearingDetector::Alarm BearingDetector::Watch(const MeasuredPeriod& in, int stepped,
                                              const int* flagged) {
  Alarm out;
  double most = in.comparable ? chart_.Cusum(s_) : chart_.LargestSum();
  if (stepped >= 0) {
    chart_.G[0][stepped] += 2 * s_.threshold;
    most = chart_.LargestSum();
  }
  const bool own_alarm = !s_.watch_only && most > s_.threshold;
  const bool alarm = flagged ? *flagged >= 0 : own_alarm, calm = in.comparable && most < kCalm;
  if (calm) calm_at_ = count_;
  if (calm && count_ % kLearnEvery == 0) learning_.Learn(model_, slopes_, kLearnEvery, &chart_);
  if (!alarm) return out;
  alarm_at_ = count_;
  bool clear = false;
  if (flagged) {
    suspect_ = *flagged;
    clear = true;
  } else {
    suspect_ = Suspect(LastPeriods(2), &clear);
    if (stepped >= 0 && !clear) {
      suspect_ = stepped;
      clear = true;
    }
  }
  raised_ = out.raised = clear;
  out.coil = clear ? suspect_ : -1;
  return out;
}

BearingDetector::Alarm BearingDetector::Next(const MeasuredPeriod& measured, const int* flagged) {
  Alarm out;
  Keep(measured);
  MaskFaultyCurrentReadings();
  MeasuredPeriod& in = ring_[static_cast<std::size_t>((count_ - 1) % kRing)].in;
  const Lane last_linkage = slopes_.last, last_voltage = slopes_.after;
  Residuals(in);
  const bool follows = follows_;
  in.comparable = in.comparable && slopes_.permeance.largest * kClosestGap < centred_;
  follows_ = in.comparable && !any_unknown_;
  if (paused_ > 0) {
    --paused_;
    if (in.comparable && chart_.LargestResidual() < kCalmResidual) calm_at_ = count_;
    return out;
  }
  if (alarm_at_ < 0) {
    const bool steps = in.comparable && follows && !any_unknown_;
    return Watch(in, steps ? StepBetweenPeriods(last_linkage, last_voltage, in) : -1, flagged);
  }
  out.more = ExamineTogether();
  const Diagnosis d = out.more.empty() ? Examine() : out.more.front();
  if (!out.more.empty()) {
    out.more.erase(out.more.begin());
    suspect_ = d.coil;
  }
  // A fault late in a period shows its coil only in the next one.
  const int patience = model_.coupling == Coupling::kSides ? 4 : 2;
  if (!raised_ && (suspect_clear_ || d.cls != FaultClass::kNone || count_ - alarm_at_ >= patience))
    raised_ = out.raised = true;
  out.coil = raised_ ? suspect_ : -1;
  const bool given_up = count_ - alarm_at_ >= kLongestExamination;
  if (d.cls != FaultClass::kNone) {
    out.diagnosis = d;
  } else if (given_up) {
    out.cleared = true;
  } else {
    return out;
  }
  alarm_at_ = -1;
  for (Lane& G : chart_.G) G = Lane{};
  return out;
}

SlopeBand BearingDetector::Band(int coil) const {
  const bool radial = model_.coupling == Coupling::kFloatingRotor;
  const double own =
      model_.SelfInductance(coil, slopes_.permeance.middle, radial ? slopes_.permeance.total : 1);
  const double slope = slopes_.phase[0].current[coil];
  return {slope, slope - chart_.e[0][coil] / own, 4 * chart_.sd[0][coil] / own};
}

}  // namespace ambrig
