#pragma once
/// The commissioned detector of one bearing: which coil's linkage moves by more or less than its
/// voltage accounts for (c, slope_excess.h), against what this bearing did when it was healthy.
///
/// Statistic of a coil: the largest |c| over its band, of windows of 1, 3, 10, 40 and 160 switching
/// periods [-]; 1: the edge of what is healthy. Its rules: docs/guide/commissioned_detector.md.
#include "fdd/commissioned/coil_probe.h"
#include "fdd/commissioned/current_swing.h"
#include "fdd/commissioned/drift_tracker.h"
#include "fdd/commissioned/fault_decision.h"
#include "fdd/detectors/coil_detector.h"
#include "fdd/examination/carried_turns.h"
#include "fdd/examination/flux_step.h"

namespace ambrig {

class CommissionedDetector : public CoilDetector {
 public:
  CommissionedDetector(const CoilDetectorSetup& setup, const CommissionedBearing& commissioned);

  CoilVerdict Watch(const MeasuredPeriod& in);
  /// Ratio of every coil.
  Lane Period(const MeasuredPeriod& in) override;

  /// A coil that is not judged any more; `share` of its turns carries on, 0: none.
  void SetTurns(int coil, double share);
  /// Nothing is concluded from the next periods but that a coil has no current.
  void Pause(int periods) { paused_ = std::max(paused_, periods); }
  /// Takes back what SetTurns said, and forgets what was seen of it; `share` of the turns carries.
  void Restore(int coil, double share = 1);
  /// A current is asked of a coil that has no turns, or is asked for none: its slopes are watched,
  /// no coil is judged. `given_up`: c that it was given up for, which a healthy coil must be well
  /// below; 0: not for its c [-].
  void BeginProbe(int coil, double given_up = 0);
  /// Whether a coil beside `coil` has just become gross, and is to be judged before a probe begins.
  bool OtherFails(int coil) const;
  /// What it showed of a coil that had turns: no current, or a gross short; else class none.
  Diagnosis EndProbe(double t);
  const CoilProbe& probe() const { return probe_; }
  /// In commissioning nothing is taken for drift.
  void IgnoreDrift() { drift_.Ignore(); }
  const SlowDrift& drift() const { return drift_.drift(); }

  const Lane& ratio() const { return ratios_.ratio(); }
  Lane Excess(int window) const { return windows().Used(window, 1); }
  const CommissionedBearing& commissioned() const { return model_; }
  const ExcessWindows& windows() const { return ratios_.windows(); }
  double band(int window, int coil) const { return bands_.band(window, coil); }
  const FluxPeriod& period() const { return period_; }
  /// What share of a shorted coil's turns carries the shaft, milliseconds after it was told.
  const CarriedTurns& carried() const { return carried_; }
  const Lane& current_error() const { return currents_.error(); }
  /// |c| of this period alone, all phases [-].
  const Lane& now() const { return ratios_.now(); }

 private:
  /// Whether a coil has lost turns, but not all.
  bool SomeHaveFewer() const;
  bool AllAreWhole() const;
  /// Whether what a coil has lost by its slopes may be the work of a loop, which leaves its leakage
  /// to them.
  bool MayBeLoop(int coil) const;
  /// A coil has other turns left than believed: means and bands begin again.
  void TakeShare(int coil, double share);
  /// A period of which nothing can be concluded.
  void Skip();
  void Probe();
  /// A coil whose current swings as no healthy one's can, or a period that such a current spoils.
  std::optional<CoilVerdict> Swings(const MeasuredPeriod& in);
  /// The reading of `coil` has made a step that its circuit cannot make.
  void TellStep(const MeasuredPeriod& in, int coil, CoilVerdict* out) const;
  /// One period of the balance that follows a loop's flux.
  void FollowCarried(const MeasuredPeriod& in, bool comparable);
  /// Of lost turns, how many the currents that carry the shaft miss.
  void TellCarried(CoilVerdict* out);
  /// Whether what both windings of a thrust side have lost may be one loop in one of them, which is
  /// the diagnosis then: it keeps the ripple out of the flux that they share, and the other one,
  /// the only one of `more`, would be whole.
  bool MayBeLoopOfSide(CoilVerdict* out) const;
  /// Whether a conclusion stands beside a coil whose shorted turns close through a resistance. What
  /// such a loop carries is in no circuit here: it moves the c of its coil and of others slowly.
  bool StandsBesideLoop(const CoilVerdict& out) const;
  bool BesideLoop() const;
  /// Of a period whose c are known; `stepped`: coil whose reading made a step that no circuit can
  /// make, -1: none.
  CoilVerdict Conclude(const MeasuredPeriod& in, int stepped);
  CoilVerdict Judge(const CoilEvidence& seen);
  CoilEvidence Evidence(const MeasuredPeriod& in) const;
  double share(int coil) const { return turns_.share[coil]; }

  CommissionedBearing model_;
  SamplingSettings sampling_;
  ExcessSettings settings_;
  double gap_ = 0;  // nominal [m]
  FluxFilter filter_;
  FluxPeriod period_;
  SlopeExcess excess_;
  BelievedTurns turns_;
  ExcessBands bands_;
  ExcessRatios ratios_;
  CommissionedRange range_;
  CoilCurrents currents_;
  TouchMonitor touch_;
  DriftTracker drift_;
  CoilProbe probe_;
  JumpWatch jumps_;
  CurrentSwing swing_;
  FluxStep step_;
  CarriedTurns carried_;
  FaultDecision decision_;
  Lane closed_;          // 1: its shorted turns close through a resistance
  bool looped_ = false;  // shorted turns of some coil may carry a current of their own
  int paused_ = 8;
  long long count_ = 0;
};

}  // namespace ambrig
