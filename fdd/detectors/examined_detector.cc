#include "fdd/detectors/examined_detector.h"

#include "core/base/errors.h"

namespace ambrig {

namespace {
constexpr int kHoldOff = 25;  // [periods]
}

ExaminedDetector::ExaminedDetector(const CoilDetectorKind& kind, const RunDetectorSetup& setup)
    : kind_(kind),
      settings_(setup.settings),
      threshold_(setup.threshold > 0 ? setup.threshold : kind.run_threshold),
      examination_(setup.model, setup.settings) {
  Require(kind.make, "a detector with a statistic");
  flags_ = kind.make(setup);
}

int ExaminedDetector::Flagged(const Lane& statistic) const {
  int flagged = -1;
  double most = threshold_;
  for (int j = 0; j < examination_.model().coils; ++j) {
    const BearingDetector::Coil state = examination_.state(j);
    if (state == BearingDetector::Coil::kLost || state == BearingDetector::Coil::kUnknownMmf)
      continue;
    if (!(statistic[j] > most)) continue;
    most = statistic[j];
    flagged = j;
  }
  return flagged;
}

DetectorAlarm ExaminedDetector::Period(const MeasuredPeriod& in) {
  const Lane statistic = flags_->Period(in);
  if (held_off_ > 0) --held_off_;
  const int flagged = held_off_ == 0 ? Flagged(statistic) : -1;
  const DetectorAlarm out = examination_.PeriodWatchedBy(flagged, in);
  const bool named = out.diagnosis.cls != FaultClass::kNone;
  if (named) flags_ = kind_.make({examination_.model(), settings_});
  if (named || out.cleared) held_off_ = kHoldOff;
  return out;
}

}  // namespace ambrig
