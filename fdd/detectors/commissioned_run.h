#pragma once
/// The commissioned detector as what drives a run (run_detector.h).
#include "fdd/detectors/commissioned_detector.h"

namespace ambrig {

class CommissionedRun : public RunDetector {
 public:
  CommissionedRun(const CoilDetectorSetup& setup, const CommissionedBearing& commissioned);

  DetectorAlarm Period(const MeasuredPeriod& in) override;
  SlopeBand Band(int coil) const override;
  /// Of the last period; a decision that stands in spite of the doubt is acted on.
  bool doubtful() const override { return doubtful_; }

 private:
  CommissionedDetector watch_;
  LinkageModel model_;
  Lane share_;  // of the turns
  bool doubtful_ = false;
};

}  // namespace ambrig
