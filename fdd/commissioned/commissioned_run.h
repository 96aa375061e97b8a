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
  void SetTurns(int coil, double share) override;
  bool BeginProbe(int coil) override;
  ProbeAnswer Probed() const override { return watch_.probe().answer(); }
  Diagnosis EndProbe(bool healthy, double t) override;

 private:
  void Lose(const Diagnosis& d);
  /// A coil has more turns than it was taken to have.
  void Regain(int coil, double turns, DetectorAlarm* alarm);
  /// Whether the supervisor did not act on such a conclusion a short time ago.
  bool WasRefused(const Diagnosis& d) const;

  CommissionedDetector watch_;
  LinkageModel model_;
  Lane share_;       // of the turns
  Lane taken_back_;  // how often a loss of turns was taken back
  Lane given_up_;    // c that each coil was given up for [-]
  long long count_ = 0;
  long long refused_until_[kLanes] = {};  // period
  bool doubtful_ = false;
};

}  // namespace ambrig
