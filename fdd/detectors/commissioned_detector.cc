#include "fdd/detectors/commissioned_detector.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

constexpr double kOfTheLargest = 0.5;  // |c| of coils that fail at once
constexpr double kAlike = 0.3;         // of the largest |c|: as if by one cause
constexpr double kProbeBand = 0.2, kUncommissionedProbeBand = 0.5;  // |c| of a healthy coil
constexpr int kAfterProbe = 8;                                      // periods
constexpr double kDeadIdle = 0.75;  // -c of a coil without current that is asked for none
constexpr double kAsked = 0.24;     // [A] set-point from which a coil is asked for current
constexpr double kBounces = 10e-3;  // [s] after a contact: its currents follow no set-point

double PeriodOf(const SamplingSettings& s) { return s.samples * s.step; }

}  // namespace

CommissionedDetector::CommissionedDetector(const CoilDetectorSetup& setup,
                                           const CommissionedBearing& commissioned)
    : model_(commissioned),
      sampling_(setup.settings.sampling),
      settings_{setup.settings.current_noise, setup.settings.adc_limit},
      gap_(setup.model.gap_offset[0]),
      filter_(setup.model, setup.settings.sampling, commissioned.circuit),
      windows_(setup.model),
      jumps_(setup.model, setup.settings.sampling, setup.settings.current_noise) {
  for (int j = 0; j < setup.model.coils; ++j) share_[j] = 1;
  SetBands();
}

void CommissionedDetector::BeginProbe(int coil) {
  // A working coil may carry a little current.
  const double idle = share_[coil] > 0 ? 0 : idle_[coil];
  probe_.Begin(coil, idle, Relies() ? kProbeBand : kUncommissionedProbeBand);
  filter_.SetTurns(coil, share_[coil] > 0 ? share_[coil] : 1);
  streak_ = Lane{};
}

Diagnosis CommissionedDetector::EndProbe(double t) {
  const int coil = probe_.coil();
  Diagnosis found;
  if (share_[coil] > 0 && probe_.answer() == ProbeAnswer::kFaulty) {
    found.coil = coil;
    found.time = found.onset = t;
    found.confidence = 1;
    const double c = probe_.excess();
    if (probe_.no_current()) {
      found.cls = FaultClass::kOpen;
    } else if (Relies() && c > kGross) {
      found.cls = FaultClass::kPartialShort;
      found.fraction = 1 - 1 / std::sqrt(1 + c);
    }
  }
  filter_.SetTurns(coil, share_[coil]);
  probe_.End();
  windows_.Clear();
  Pause(kAfterProbe);
  return found;
}

void CommissionedDetector::WatchRange(const MeasuredPeriod& in) {
  touching_ = in.uncertainty.any();
  if (touching_) touched_ = in.t;
  bounces_ = in.t < touched_ + kBounces;
  // Iron that takes less flux than its model leaves the rest to all other poles: from two of eight their
  // c is a third at most.
  Lane beyond;
  int many = 0;
  for (int j = 0; j < filter_.nominal().coils && model_.learnt; ++j) {
    beyond[j] = share_[j] > 0 && period_.largest_flux[j] > model_.largest_flux[j];
    many += beyond[j] > 0;
  }
  out_of_range_ = many > 0;
  for (int j = 0; j < kLanes; ++j)
    gross_above_[j] = many == 0                               ? kGross
                      : beyond[j] > 0 || many >= kCoilsAtOnce ? kGrossAbove
                                                              : kGrossBeside;
}

bool CommissionedDetector::Disturbed() const {
  if (calm_) return false;
  // A fault stands out from what it throws at its neighbours; the model's errors are alike.
  const double alike = kAlike * *std::max_element(level_.v, level_.v + kLanes);
  int beyond = 0;
  for (int j = 0; j < kLanes; ++j) beyond += ratio_[j] > 1 && level_[j] >= alike;
  return beyond >= kCoilsAtOnce || windows_.Pattern(kLevelWindow) > PatternLimit();
}

double CommissionedDetector::LargestNow() const {
  double most = 0;
  for (double c : now_.v) most = std::max(most, std::abs(c));
  return most;
}

int CommissionedDetector::GrossCoils() const {
  int many = 0;
  for (double c : now_.v) many += c > kGross;
  return many;
}

bool CommissionedDetector::Decided(int coil, double excess) const {
  const bool gross =
      excess < -kGross || excess > (out_of_range_ ? gross_above_[coil] : kGrossAbove);
  if (Relies() && (!out_of_range_ || gross) && !Disturbed())
    return PhasesAgree(coil) || CurrentIsFalse(coil) || HasNoCurrent(coil);
  if (MayBounce()) return false;
  if (gross && HasNoCurrent(coil)) return true;
  // Inside what was learnt no error of the model is as large: several coils have failed at once.
  // What these throw at a healthy neighbour is smaller.
  if (Relies() && !out_of_range_ && gross)
    return PhasesAgree(coil) && std::abs(excess) > kOfTheLargest * LargestNow();
  return gross && CurrentIsFalse(coil) && (excess < 0 || GrossCoils() < kCoilsAtOnce);
}

CommissionedDetector::Outcome CommissionedDetector::Watch(const MeasuredPeriod& in) {
  ++count_;
  calm_ = false;
  const FluxFilter::State before = filter_.state();
  filter_.Period(in, &period_);
  WatchCurrents(in);
  const int stepped = jumps_.Period(in, now_);
  const double nearest = kClosestGap * gap_;
  const double reach = gap_ - nearest;
  const bool comparable = in.comparable && in.x1 * in.x1 + in.y1 * in.y1 < reach * reach;
  if (!comparable) {
    ratio_ = streak_ = dead_ = Lane{};
    joint_.Clear();
    return {};
  }
  if (probe_.running()) {
    Lane probed;
    probed[probe_.coil()] = share_[probe_.coil()] > 0 ? share_[probe_.coil()] : 1;
    ComputeSlopeExcess(filter_, model_.coils, settings_, period_, probed, &excess_);
    probe_.Add(excess_, period_.largest[probe_.coil()]);
    ratio_ = Lane{};
    return {};
  }
  ComputeSlopeExcess(filter_, model_.coils, settings_, period_, share_, &excess_);
  drift_.TakeOff(&excess_);
  WatchRange(in);
  Ratios();
  if (calm_)
    joint_.Clear();
  else
    joint_.Keep(in, sampling_.samples, before);
  if (paused_ > 0) {
    --paused_;
    streak_ = Lane{};
    jumps_.Forget();
    CountDead(in);
    return DeadInAPause(in.t);
  }
  Outcome out = Judge(in);
  FollowDrift(out.doubtful || out.alarm);
  if (out.decided) {
    jumps_.Forget();
  } else if (stepped >= 0 && share_[stepped] == 1) {
    out.alarm = out.decided = true;
    out.diagnosis = {
        stepped, FaultClass::kCurrentSensor, 0, in.t + PeriodOf(sampling_), jumps_.onset(), 1};
  }
  return out;
}

CommissionedDetector::Outcome CommissionedDetector::Judge(const MeasuredPeriod& in) {
  Outcome out;
  out.doubtful = !Relies() || out_of_range_ || Disturbed();
  if (calm_) {
    streak_ = dead_ = Lane{};
    return out;
  }
  const int coil =
      static_cast<int>(std::max_element(ratio_.v, ratio_.v + filter_.nominal().coils) - ratio_.v);
  out.alarm = ratio_[coil] > 1;
  CountStreaks(in);
  if (!out.alarm || streak_[coil] < static_cast<int>(kInARow)) return out;
  out.excess = RecentExcess(coil);
  if (JudgedTogether(in, &out)) return out;
  out.turns = MoreTurns(coil, out.excess);
  out.decided = out.turns > 0 || Decided(coil, out.excess);
  if (!out.decided) return out;
  out.diagnosis = Classify(coil, out.excess, in.t);
  if (out.turns == 0) out.more = Companions(coil, out.excess, in.t);
  return out;
}

CommissionedDetector::Outcome CommissionedDetector::DeadInAPause(double t) const {
  Outcome out;
  const std::vector<Diagnosis> failed = CoilsWithoutCurrent(t);
  if (failed.empty() || MayBounce()) return out;
  out.alarm = out.decided = true;
  out.excess = now_[failed[0].coil];
  out.Blame(failed);
  return out;
}

void CommissionedDetector::CountDead(const MeasuredPeriod& in) {
  for (int j = 0; j < filter_.nominal().coils; ++j) {
    // The diodes of a coil that is asked for no current block: its flux stands, whatever the bridge does.
    const bool asked = !in.set_point || (*in.set_point)[j] > kAsked;
    const bool dead = period_.largest[j] < kConducts && now_[j] < -(asked ? kGross : kDeadIdle);
    if (dead_[j] == 0) dead_since_[j] = in.t;
    dead_[j] = dead ? dead_[j] + 1 : 0;
  }
}

void CommissionedDetector::CountStreaks(const MeasuredPeriod& in) {
  CountDead(in);
  const double least = kCompanion * *std::max_element(ratio_.v, ratio_.v + kLanes);
  for (int j = 0; j < filter_.nominal().coils; ++j) {
    if (!(ratio_[j] > 1) || ratio_[j] < least) {
      streak_[j] = 0;
      continue;
    }
    if (streak_[j] == 0) onset_[j] = in.t;
    ++streak_[j];
  }
}

Lane CommissionedDetector::Period(const MeasuredPeriod& in) {
  Watch(in);
  if (calm_) RatiosOfWindows();
  return ratio_;
}

}  // namespace ambrig
