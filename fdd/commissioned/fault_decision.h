#pragma once
/// Which coils of a bearing have failed: the one of the largest ratio, when it has been above 1 in
/// three periods in a row and the evidence suffices (coil_evidence.h), or several at once where one
/// solution for the turns of all coils says so (joint_turns.h).
#include "fdd/commissioned/coil_evidence.h"
#include "fdd/commissioned/coil_verdict.h"
#include "fdd/examination/joint_turns.h"

namespace ambrig {

class FaultDecision {
 public:
  /// A period that is not calm; `before`: state of the circuit at its start.
  void Keep(const MeasuredPeriod& in, int samples, const FluxFilter::State& before) {
    joint_.Keep(in, samples, before);
  }
  void ForgetPeriods() { joint_.Clear(); }
  void ForgetStreaks() { streak_ = Lane{}; }

  /// Of a period that is not calm.
  CoilVerdict Judge(const CoilEvidence& seen);
  /// Coils without current, which no other coil's turns can feign: concluded in a pause, too.
  CoilVerdict WithoutCurrent(const CoilEvidence& seen) const;

 private:
  void CountStreaks(const CoilEvidence& seen);
  /// Share of its turns that a coil truly has that is taken for one with fewer; 0: not so.
  double MoreTurns(const CoilEvidence& seen, int coil, double excess) const;
  /// Which coils have failed, all judged together: no current, or shares of their
  /// turns that explain all c. False: no such explanation.
  bool JudgedTogether(const CoilEvidence& seen, CoilVerdict* out) const;
  std::vector<Diagnosis> CoilsWithoutCurrent(const CoilEvidence& seen) const;
  /// Whether c is gross in three coils or more of both polarities, or in two that are to be blamed
  /// for lost turns, and none of these became so at an instant: windings do not fail so, the model
  /// is not that of the machine.
  bool IsMismatch(const CoilEvidence& seen, const CoilVerdict& out) const;
  /// Nothing but coils without current is concluded of a machine that the model is not of.
  CoilVerdict InMismatch(const CoilEvidence& seen, CoilVerdict out) const;
  /// Whether turns were lost on the same thrust core a short time ago. Two windings of
  /// one flux that are named in turns say that the model errs.
  bool ShortedAgain(const CoilEvidence& seen, const Diagnosis& d) const;
  /// Whether a small short is not named yet, because another coil is about to stand out as much: of
  /// two that lost turns at one instant each hides a part of the other, and after the
  /// first is named the windows of the second begin again.
  bool AwaitsCompanion(const CoilEvidence& seen, const Diagnosis& d, double excess) const;
  /// Other coils whose own c is as gross as that of the coil that was decided.
  std::vector<Diagnosis> Companions(const CoilEvidence& seen, int decided, double excess) const;
  bool InARow(int coil) const { return streak_[coil] >= static_cast<int>(ExcessLimits::kInARow); }

  JointTurns joint_;
  Lane streak_, onset_;           // periods in a row that a coil was suspect; since [s]
  long long mismatch_until_ = 0;  // period
  int waited_ = 0;                // periods for a companion, since nothing stood out
};

}  // namespace ambrig
