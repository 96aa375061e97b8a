#pragma once
/// A detector that only flags coils, in a run: its statistic raises the alarm, the examination of
/// BearingDetector names coil, class and size.
///
///   - An alarm is raised when the largest statistic of the coils that are not lost exceeds the
///     threshold; it names that coil until the examination finds another one to be the faulty one.
///   - After a diagnosis the flagging detector begins again with the circuit that is left,
///     so that a partial short that is known raises no second alarm; lost coils are not looked
///     at any more.
///   - After a diagnosis and after an alarm that the examination cleared, nothing is flagged for 25
///     periods (1 ms of the reference rig): the currents move, and a statistic that holds its value
///     would raise the same alarm again.
#include "fdd/detectors/bearing_detector.h"
#include "fdd/detectors/coil_detector.h"

namespace ambrig {

class ExaminedDetector : public RunDetector {
 public:
  ExaminedDetector(const CoilDetectorKind& kind, const RunDetectorSetup& setup);

  DetectorAlarm Period(const MeasuredPeriod& in) override;
  SlopeBand Band(int coil) const override { return examination_.Band(coil); }
  double threshold() const { return threshold_; }

 private:
  /// Coil with the largest statistic above the threshold, -1: none.
  int Flagged(const Lane& statistic) const;

  CoilDetectorKind kind_;
  DetectorSettings settings_;
  double threshold_;
  std::unique_ptr<CoilDetector> flags_;
  BearingDetector examination_;
  int held_off_ = 0;  // [periods]
};

}  // namespace ambrig
