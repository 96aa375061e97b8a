#include "fdd/commissioned/commissioned_detector.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

constexpr double kProbeBand = 0.2, kUncommissionedProbeBand = 0.5;  // |c| of a healthy coil
constexpr double kLeastProbeBand = 0.08, kOfGivenUp = 0.5;  // of |c| that it was given up for
constexpr int kBeforeProbe = 3;                             // window of 40 periods
constexpr int kAfterProbe = 8, kAfterShare = 25;            // periods

}  // namespace

CommissionedDetector::CommissionedDetector(const CoilDetectorSetup& setup,
                                           const CommissionedBearing& commissioned)
    : model_(commissioned),
      sampling_(setup.settings.sampling),
      settings_{setup.settings.current_noise, setup.settings.adc_limit},
      gap_(setup.model.gap_offset[0]),
      filter_(setup.model, setup.settings.sampling, commissioned.circuit),
      bands_(setup.model, commissioned),
      ratios_(setup.model, commissioned),
      range_(setup.model, commissioned),
      currents_(setup.model, setup.settings.sampling, setup.settings.current_noise),
      drift_(setup.model, setup.settings.sampling, commissioned.usable()),
      jumps_(setup.model, setup.settings.sampling, setup.settings.current_noise),
      swing_(setup.model, setup.settings.sampling, setup.settings.current_noise),
      step_(setup.model, setup.settings.sampling),
      carried_(filter_, setup.settings.sampling, commissioned.coils) {
  for (int j = 0; j < setup.model.coils; ++j) turns_.share[j] = 1;
}

void CommissionedDetector::SetTurns(int coil, double share) {
  if (share == 0) ratios_.Leave(coil);
  TakeShare(coil, share);
}

void CommissionedDetector::Restore(int coil, double share) {
  ratios_.Return(coil);
  TakeShare(coil, share);
}

bool CommissionedDetector::SomeHaveFewer() const {
  const auto* share = turns_.share.v;
  return std::any_of(share, share + filter_.nominal().coils,
                     [](double left) { return left > 0 && left < 1; });
}

bool CommissionedDetector::AllAreWhole() const {
  const auto* share = turns_.share.v;
  return std::all_of(share, share + filter_.nominal().coils, [](double left) { return left == 1; });
}

void CommissionedDetector::TakeShare(int coil, double share) {
  // A loop goes on in the flux of its pole when the coil is switched off.
  if (share == 0 || share == 1) closed_[coil] = share == 0 && MayBeLoop(coil) ? 1 : 0;
  turns_.share[coil] = share;
  turns_.taken[coil] = count_;
  filter_.SetTurns(coil, share);
  carried_.TurnsChange();
  ratios_.ClearWindows();
  // Turns that close through a resistance carry a current of their own, which no share expresses;
  // they do so too where the coil is switched off afterwards.
  looped_ = SomeHaveFewer() || (looped_ && !AllAreWhole());
  ratios_.TakeSense(filter_.nominal().coupling == Coupling::kFloatingRotor && looped_);
  bands_.Set(model_, turns_);
  Pause(kAfterShare);
}

void CommissionedDetector::BeginProbe(int coil, double given_up) {
  // A working coil may carry a little current.
  const double idle = share(coil) > 0 ? 0 : currents_.idle(coil);
  double band = model_.usable() ? kProbeBand : kUncommissionedProbeBand;
  if (model_.usable() && given_up != 0)
    band = std::clamp(kOfGivenUp * std::abs(given_up), kLeastProbeBand, band);
  probe_.Begin(coil, idle, band);
  filter_.SetTurns(coil, share(coil) > 0 ? share(coil) : 1);
  decision_.ForgetStreaks();
}

bool CommissionedDetector::OtherFails(int coil) const {
  const Lane before = Excess(kBeforeProbe);
  for (int j = 0; j < filter_.nominal().coils && model_.usable(); ++j)
    if (j != coil && share(j) > 0 && std::abs(ratios_.now()[j]) > ExcessLimits::kGross &&
        std::abs(before[j]) < ExcessLimits::kGross)
      return true;
  return false;
}

Diagnosis CommissionedDetector::EndProbe(double t) {
  const int coil = probe_.coil();
  Diagnosis found;
  if (share(coil) > 0 && probe_.answer() == ProbeAnswer::kFaulty) {
    found.coil = coil;
    found.time = found.onset = t;
    found.confidence = 1;
    const double c = probe_.excess();
    if (probe_.no_current()) {
      found.cls = FaultClass::kOpen;
    } else if (model_.usable() && c > ExcessLimits::kGross) {
      found.cls = FaultClass::kPartialShort;
      found.fraction = 1 - 1 / std::sqrt(1 + c);
    }
  }
  filter_.SetTurns(coil, share(coil));
  probe_.End();
  ratios_.ClearWindows();
  Pause(kAfterProbe);
  return found;
}

CoilVerdict CommissionedDetector::Watch(const MeasuredPeriod& in) {
  ++count_;
  ratios_.Begin();
  filter_.Period(in, &period_);
  currents_.Update(in, turns_.share, bands_.most_missed());
  const int stepped = jumps_.Period(in, ratios_.now(), period_.conducts);
  const double nearest = kClosestGap * gap_;
  const double reach = gap_ - nearest;
  const bool comparable = in.comparable && in.x1 * in.x1 + in.y1 * in.y1 < reach * reach;
  FollowCarried(in, comparable);
  if (!comparable || probe_.running()) {
    if (comparable)
      Probe();
    else
      Skip();
    return {};
  }
  step_.Keep(in);
  if (const auto swings = Swings(in)) return *swings;
  ComputeSlopeExcess(filter_, model_.coils, settings_, period_, turns_.share, &excess_);
  drift_.TakeOff(&excess_);
  touch_.Update(in);
  range_.Update(period_, excess_, jumps_, turns_, count_);
  const bool only_gross = touch_.touching() || range_.left();
  const bool left = range_.left() && !touch_.touching();
  ratios_.Update(excess_, {bands_, range_.gross_above(), only_gross, left, count_});
  if (drift_.TakesFirst(!only_gross && !bands_.widened(), ratios_.windows(), bands_)) {
    ratios_.Restart();
    decision_.ForgetStreaks();
    return {};
  }
  if (ratios_.calm())
    decision_.ForgetPeriods();
  else
    decision_.Keep(in, sampling_.samples, filter_.before());
  if (paused_ > 0) {
    --paused_;
    decision_.ForgetStreaks();
    jumps_.Forget();
    currents_.CountWithout(in, period_, excess_, ratios_.now(), turns_.share);
    return decision_.WithoutCurrent(Evidence(in));
  }
  return Conclude(in, stepped);
}

CoilVerdict CommissionedDetector::Conclude(const MeasuredPeriod& in, int stepped) {
  CoilVerdict out = Judge(Evidence(in));
  if (out.decided && !StandsBesideLoop(out)) {
    out.decided = false;
    out.doubtful = true;
  }
  if (out.decided && out.turns == 0) TellCarried(&out);
  turns_.erred = turns_.erred || out.turns == 1;
  if (!out.doubtful && !out.alarm && !touch_.touching())
    drift_.Follow(count_, ratios_.windows(), bands_);
  if (out.decided)
    jumps_.Forget();
  else if (stepped >= 0 && share(stepped) == 1)
    TellStep(in, stepped, &out);
  return out;
}

void CommissionedDetector::TellStep(const MeasuredPeriod& in, int coil, CoilVerdict* out) const {
  if (BesideLoop()) {
    out->doubtful = true;
    return;
  }
  out->alarm = out->decided = true;
  const double end = in.t + sampling_.samples * sampling_.step;
  out->diagnosis = {coil, FaultClass::kCurrentSensor, 0, end, jumps_.onset(), 1};
}

std::optional<CoilVerdict> CommissionedDetector::Swings(const MeasuredPeriod& in) {
  const int coil = swing_.Period(in, jumps_.largest(), period_.largest, turns_.share);
  if (!swing_.unsettled()) return {};
  CoilVerdict out;
  out.doubtful = true;
  if (coil >= 0) {
    out.alarm = out.decided = true;
    const double end = in.t + sampling_.samples * sampling_.step;
    out.diagnosis = {coil, FaultClass::kPartialShort, swing_.Lost(coil), end, in.t, 1};
    out.diagnosis.ripple_fraction = out.diagnosis.fraction;
    swing_.Forget();
  }
  // c of before stays known: turns that were lost at once are to be told so afterwards.
  ratios_.Skip(false);
  range_.Forget();
  currents_.ForgetWithout();
  decision_.ForgetStreaks();
  decision_.ForgetPeriods();
  return out;
}

void CommissionedDetector::Skip() {
  step_.Clear();
  ratios_.Skip(true);
  range_.Forget();
  currents_.ForgetWithout();
  decision_.ForgetStreaks();
  decision_.ForgetPeriods();
}

void CommissionedDetector::Probe() {
  const int coil = probe_.coil();
  Lane judged = turns_.share;
  judged[coil] = share(coil) > 0 ? share(coil) : 1;
  ComputeSlopeExcess(filter_, model_.coils, settings_, period_, judged, &excess_);
  if (model_.usable()) probe_.WatchOthers(excess_);
  probe_.Add(excess_, period_.largest[coil]);
  ratios_.Skip(false);
  range_.Forget();
}

CoilVerdict CommissionedDetector::Judge(const CoilEvidence& seen) {
  const bool calm = ratios_.calm();
  // What flux a winding of a thrust side shares with its partner may keep its c calm
  // although it has no current.
  const bool shares_flux = filter_.nominal().coupling == Coupling::kSides && currents_.AnySuspect();
  if (!calm || shares_flux)
    currents_.CountWithout(seen.in, period_, excess_, ratios_.now(), turns_.share);
  else
    currents_.ForgetWithout();
  if (shares_flux)
    if (CoilVerdict failed = decision_.WithoutCurrent(seen); failed.decided) return failed;
  if (!calm) return decision_.Judge(seen);
  decision_.ForgetStreaks();
  return CoilVerdict::Calm(seen.Doubtful());
}

CoilEvidence CommissionedDetector::Evidence(const MeasuredPeriod& in) const {
  return {model_, sampling_, settings_, filter_, period_, excess_, in,
          turns_, ratios_,   currents_, range_,  touch_,  count_};
}

Lane CommissionedDetector::Period(const MeasuredPeriod& in) {
  Watch(in);
  if (ratios_.calm()) ratios_.CompareWindows(bands_);
  return ratios_.ratio();
}

}  // namespace ambrig
