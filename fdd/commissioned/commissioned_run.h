#pragma once
/// The commissioned detector as what drives a run (run_detector.h).
#include "fdd/commissioned/commissioned_detector.h"

namespace ambrig {

class CommissionedRun : public RunDetector {
 public:
  CommissionedRun(const CoilDetectorSetup& setup, const CommissionedBearing& commissioned);

  DetectorAlarm Period(const MeasuredPeriod& in) override;
  SlopeBand Band(int coil) const override;
  /// Of the last period; a decision that stands in spite of the doubt is acted on.
  bool doubtful() const override { return doubtful_; }
  bool BeginProbe(int coil) override;
  ProbeAnswer Probed() const override { return watch_.probe().answer(); }
  Diagnosis EndProbe(bool healthy, double t) override;

 private:
  void Lose(const Diagnosis& d);

  CommissionedDetector watch_;
  LinkageModel model_;
  Lane share_;       // of the turns
  Lane taken_back_;  // how often a loss of turns was taken back
  bool doubtful_ = false;
};

}  // namespace ambrig
