#include "fdd/commissioned/commissioned_run.h"

#include <algorithm>

#include "fdd/learning/commissioning_file.h"
#include "rig/parameters/detection_parameters.h"

namespace ambrig {

namespace {
constexpr double kMostTakenBack = 3;  // losses of turns of one coil, the next one is final
constexpr long long kRefused = 2500;  // periods in which the same is not concluded again
}  // namespace

CommissionedRun::CommissionedRun(const CoilDetectorSetup& setup,
                                 const CommissionedBearing& commissioned)
    : watch_(setup, commissioned), model_(setup.model) {
  for (double& v : share_.v) v = 1;
}

DetectorAlarm CommissionedRun::Period(const MeasuredPeriod& in) {
  DetectorAlarm alarm;
  ++count_;
  const CoilVerdict seen = watch_.Watch(in);
  doubtful_ = seen.doubtful && !seen.decided;
  if (watch_.carried().moved()) {
    alarm.carrying = watch_.carried().coil();
    alarm.carried = watch_.carried().share();
  }
  if (!seen.decided) return alarm;
  const Diagnosis& d = seen.diagnosis;
  if (seen.turns == 0 && WasRefused(d)) {
    doubtful_ = true;
    return alarm;
  }
  alarm.coil = d.coil;
  if (seen.turns > 0 && taken_back_[d.coil] < kMostTakenBack) {
    ++taken_back_[d.coil];
    Regain(d.coil, seen.turns, &alarm);
    return alarm;
  }
  // A share of turns that is more than was believed is no loss, whoever concludes it.
  if (d.cls == FaultClass::kPartialShort && d.fraction < 0) {
    Regain(d.coil, std::min(1.0, share_[d.coil] * (1 - d.fraction)), &alarm);
    return alarm;
  }
  alarm.raised = true;
  alarm.diagnosis = d;
  alarm.more = seen.more;
  Lose(d);
  for (const Diagnosis& other : alarm.more) Lose(other);
  for (const Diagnosis& other : seen.beside) Lose(other);
  return alarm;
}

void CommissionedRun::Regain(int coil, double turns, DetectorAlarm* alarm) {
  alarm->restored = turns;
  share_[coil] = turns;
  watch_.Restore(coil, turns);
}

void CommissionedRun::Lose(const Diagnosis& d) {
  const double lost = d.ripple_fraction > 0 ? d.ripple_fraction : d.fraction;
  share_[d.coil] = d.cls == FaultClass::kPartialShort ? share_[d.coil] * (1 - lost) : 0;
  given_up_[d.coil] = d.excess;
  watch_.SetTurns(d.coil, share_[d.coil]);
}

bool CommissionedRun::WasRefused(const Diagnosis& d) const {
  return d.cls != FaultClass::kOpen && count_ < refused_until_[d.coil];
}

void CommissionedRun::SetTurns(int coil, double share) {
  if (share > share_[coil]) refused_until_[coil] = count_ + kRefused;
  share_[coil] = share;
  if (share > 0)
    watch_.Restore(coil, share);
  else
    watch_.SetTurns(coil, 0);
}

bool CommissionedRun::BeginProbe(int coil) {
  if (watch_.OtherFails(coil)) return false;
  watch_.BeginProbe(coil, share_[coil] > 0 ? 0 : given_up_[coil]);
  return true;
}

Diagnosis CommissionedRun::EndProbe(bool healthy, double t) {
  const int coil = watch_.probe().coil();
  const Diagnosis found = watch_.EndProbe(t);
  if (share_[coil] > 0) {
    if (found.cls != FaultClass::kNone) Lose(found);
    return found;
  }
  if (healthy) {
    share_[coil] = 1;
    watch_.Restore(coil);
  }
  return {};
}

SlopeBand CommissionedRun::Band(int coil) const {
  // The relative excess of the linkage moves the current's slope the other way, by as much.
  const FluxPhase& on = watch_.period().phase[0];
  SlopeBand band;
  band.slope = on.current[coil];
  band.expected = band.slope * (1 - watch_.windows().OfPhase(coil, 0, 1));
  band.half_width = std::abs(band.expected) * watch_.band(0, coil);
  return band;
}

namespace {

/// What a file says of the bearing; nominal without a file.
CommissionedBearing BearingOf(const CoilDetectorSetup& s) {
  return ReadCommissionedBearing(s.commissioning, s.bearing, s.model,
                                 *s.settings.sampling.amplifier);
}

}  // namespace

CoilDetectorKind Commissioned() {
  return {kCommissionedDetector,
          "-",
          "relative excess of the linkages' slopes over what the healthy machine showed",
          1,
          1,
          [](const CoilDetectorSetup& s) -> std::unique_ptr<CoilDetector> {
            return std::make_unique<CommissionedDetector>(s, BearingOf(s));
          },
          [](const RunDetectorSetup& s) -> std::unique_ptr<RunDetector> {
            return std::make_unique<CommissionedRun>(s, BearingOf(s));
          }};
}

}  // namespace ambrig
