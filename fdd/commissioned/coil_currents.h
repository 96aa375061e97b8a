#pragma once
/// What the readings of the currents of a bearing say by themselves: which ones miss their
/// set-points, which coils have no current although they are driven, and the reading of coils whose
/// bridge is off.
///
/// A coil without current is one that is asked for some, or whose linkage moves by less
/// than a quarter of what its voltage would do: the diodes of a coil that is asked for none block.
/// A bridge that is on for a small part of a period gives next to no current, and the slopes of few
/// samples are noise: the periods count by what they tell, as the logarithm of how much likelier
/// they are without current (c = -1) than of a healthy coil (c = 0).
/// The c of a winding of a thrust side without current is hardly below zero, as its partner moves
/// the flux of both: it is one that misses its set-point although it is driven at least as hard as
/// its partner, and whose reading stands still beside the partner's ripple.
#include "fdd/circuit/slope_excess.h"
#include "fdd/commissioned/believed_turns.h"

namespace ambrig {

class CoilCurrents {
 public:
  /// `noise`: of a sample, quantisation included [A rms].
  CoilCurrents(const LinkageModel& nominal, const SamplingSettings& sampling, double noise);

  /// One period. `most_missed`: |set-point - mean| of a healthy current at most [A].
  void Update(const MeasuredPeriod& in, const Lane& share, const Lane& most_missed);
  /// Counts the coils without current; `c`: of this period alone [-], from `excess`.
  void CountWithout(const MeasuredPeriod& in, const FluxPeriod& flux, const SlopeExcess& excess,
                    const Lane& c, const Lane& share);
  void ForgetWithout() { without_ = Lane{}; }

  /// Mean reading of the last period [A].
  const Lane& mean() const { return mean_; }
  /// |set-point - mean| over two periods [A].
  const Lane& error() const { return error_; }
  /// Whether the current has missed its set-point in two periods in a row.
  bool IsFalse(int coil) const;
  /// Whether the reading has been zero in three periods in a row although the bridge drives, or in
  /// as many more as tell it surely.
  bool IsMissing(int coil) const;
  double missing_since(int coil) const { return since_[coil]; }  // [s]
  /// Whether any coil misses its set-point in this period, or had no current in the last.
  bool AnySuspect() const;
  /// Mean reading of a coil without turns [A].
  double idle(int coil) const { return idle_[coil]; }

 private:
  /// Whether a winding of a thrust side misses current that its voltage would give it, had
  /// it any: the winding that is driven at least as hard as its partner takes over what
  /// that carries more, whatever flux both share.
  bool LeftToPartner(const MeasuredPeriod& in, int coil, const Lane& share) const;

  int coils_, samples_;
  bool thrust_;
  double noise_;                   // [A]
  double least_;                   // set-point that the amplifier can follow [A]
  Lane mean_, last_miss_, error_;  // [A]
  Lane false_;                     // periods in a row
  Lane without_, since_;           // periods in a row without current though driven; since [s]
  Lane likelihood_;                // of them, logarithm: no current over a healthy coil
  Lane idle_;
};

}  // namespace ambrig
