#include "fdd/detectors/commissioned_detector.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

constexpr double kOfTheLargest = 0.5;  // |c| of coils that fail at once
constexpr double kAlike = 0.3;         // of the largest |c|: as if by one cause
constexpr double kProbeBand = 0.2, kUncommissionedProbeBand = 0.5;  // |c| of a healthy coil
constexpr int kAfterProbe = 8;                                      // periods
constexpr double kDeadIdle = 0.75;   // -c of a coil without current that is asked for none
constexpr double kAsked = 0.24;      // [A] set-point from which a coil is asked for current
constexpr double kRangeOfNoise = 8;  // sd: of the readings of a winding whose current does not move
constexpr double kStill = 0.25;      // of the range of its partner's
constexpr double kMostWider = 1.25, kSpare = 1.02;  // of the commissioned range of flux
constexpr int kWiderPeriods = 250;
constexpr double kSudden = 0.15;  // c of one period, as a coil leaves its range
constexpr double kOverHealthy =
    2;  // the same over the largest c that healthy running made of one period
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
    beyond[j] = share_[j] > 0 && period_.largest_flux[j] > model_.largest_flux[j] && LeavesRange(j);
    many += beyond[j] > 0;
  }
  last_flux_ = period_.largest_flux;
  out_of_range_ = many > 0;
  for (int j = 0; j < kLanes; ++j)
    gross_above_[j] = many == 0                               ? kGross
                      : beyond[j] > 0 || many >= kCoilsAtOnce ? kGrossAbove
                                                              : kGrossBeside;
}

bool CommissionedDetector::LeavesRange(int coil) {
  const double flux = period_.largest_flux[coil], range = model_.largest_flux[coil];
  if (last_flux_[coil] > 0 && last_flux_[coil] <= range && FluxJumps(coil)) {
    wider_range_[coil] = range * std::min(kMostWider, kSpare * flux / last_flux_[coil]);
    wider_until_[coil] = count_ + kWiderPeriods;
  }
  return count_ > wider_until_[coil] || flux > wider_range_[coil];
}

bool CommissionedDetector::FluxJumps(int coil) const {
  const double top = excess_.top[0][coil] + excess_.top[1][coil],
               bottom = excess_.bottom[0][coil] + excess_.bottom[1][coil];
  const double sudden = std::max(kSudden, kOverHealthy * model_.largest[0][coil]);
  return top > sudden * std::max(bottom, kJudgedWeight) || jumps_.jump(coil) > 0;
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
  if (LessThanATurn(coil, excess)) return false;
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
  // A learnt model that was refused errs by a few tenths of c, and in its phases alike; not by half of the turns at once.
  const bool witnessed =
      CurrentIsFalse(coil) || (model_.learnt && jumped_[coil] > 0 && PhasesAgree(coil));
  return gross && witnessed &&
         (excess < 0 || (GrossCoils() < kCoilsAtOnce && (Relies() || jumped_[coil] > 0)));
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
    ratio_ = streak_ = dead_ = last_flux_ = Lane{};
    for (Lane& c : last_now_) std::fill_n(c.v, kLanes, kGross);
    joint_.Clear();
    return {};
  }
  if (probe_.running()) {
    Lane probed;
    probed[probe_.coil()] = share_[probe_.coil()] > 0 ? share_[probe_.coil()] : 1;
    ComputeSlopeExcess(filter_, model_.coils, settings_, period_, probed, &excess_);
    probe_.Add(excess_, period_.largest[probe_.coil()]);
    ratio_ = last_flux_ = Lane{};
    return {};
  }
  ComputeSlopeExcess(filter_, model_.coils, settings_, period_, share_, &excess_);
  drift_.TakeOff(&excess_);
  WatchRange(in);
  Ratios();
  if (!Relies()) WatchJumps();
  if (TakesFirstDrift()) return {};
  if (calm_)
    joint_.Clear();
  else
    joint_.Keep(in, sampling_.samples, before);
  if (paused_ > 0) {
    --paused_;
    streak_ = Lane{};
    jumps_.Forget();
    CountDead(in);
    return WithoutCurrent(in.t);
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
  // What flux a winding of a thrust side shares with its partner may keep its c calm although it has no current.
  const bool shares_flux = filter_.nominal().coupling == Coupling::kSides && SomeMissItsCurrent();
  if (!calm_ || shares_flux)
    CountDead(in);
  else
    dead_ = Lane{};
  if (shares_flux)
    if (const Outcome failed = WithoutCurrent(in.t); failed.decided) return failed;
  if (calm_) {
    streak_ = Lane{};
    return out;
  }
  const int coil =
      static_cast<int>(std::max_element(ratio_.v, ratio_.v + filter_.nominal().coils) - ratio_.v);
  out.alarm = ratio_[coil] > 1;
  if (!out.alarm) waited_ = 0;
  CountStreaks(in);
  if (!out.alarm || streak_[coil] < static_cast<int>(kInARow)) return out;
  out.excess = RecentExcess(coil);
  if (!JudgedTogether(in, &out)) {
    out.turns = MoreTurns(coil, out.excess);
    erred_ = erred_ || out.turns == 1;
    out.decided = out.turns > 0 || Decided(coil, out.excess);
    if (!out.decided) return out;
    out.diagnosis = Classify(coil, out.excess, in.t);
    if (out.turns == 0) {
      if (AwaitsCompanion(out.diagnosis, out.excess)) {
        ++waited_;
        out.decided = false;
        return out;
      }
      out.more = Companions(coil, out.excess, in.t);
    }
  }
  if (out.decided && out.turns == 0 && ShortedAgain(out.diagnosis)) {
    out.decided = false;
    out.doubtful = true;
  }
  return out;
}

bool CommissionedDetector::SomeMissItsCurrent() const {
  for (int j = 0; j < filter_.nominal().coils; ++j)
    if (false_current_[j] > 0 || dead_[j] > 0) return true;
  return false;
}

bool CommissionedDetector::LeftToPartner(const MeasuredPeriod& in, int coil) const {
  const int partner = coil ^ 1;
  if (filter_.nominal().coupling != Coupling::kSides || !in.set_point || share_[coil] == 0 ||
      share_[partner] == 0 || (*in.set_point)[coil] < kAsked || false_current_[coil] == 0 ||
      (*in.duty)[coil] < (*in.duty)[partner])
    return false;
  const auto range = [&](int j) {
    double least = in.adc[0][j], most = least;
    for (int k = 1; k < sampling_.samples; ++k) {
      least = std::min(least, in.adc[k][j]);
      most = std::max(most, in.adc[k][j]);
    }
    return most - least;
  };
  const double own = range(coil);
  return own < kRangeOfNoise * settings_.current_noise && own < kStill * range(partner);
}

void CommissionedDetector::CountDead(const MeasuredPeriod& in) {
  for (int j = 0; j < filter_.nominal().coils; ++j) {
    // The diodes of a coil that is asked for no current block: its flux stands, whatever the bridge does.
    const bool asked = !in.set_point || (*in.set_point)[j] > kAsked;
    const bool dead = (period_.largest[j] < kConducts && now_[j] < -(asked ? kGross : kDeadIdle)) ||
                      LeftToPartner(in, j);
    if (dead_[j] == 0) dead_since_[j] = in.t;
    dead_[j] = dead ? dead_[j] + 1 : 0;
  }
}

void CommissionedDetector::CountStreaks(const MeasuredPeriod& in) {
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
