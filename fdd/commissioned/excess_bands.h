#pragma once
/// Bands that the relative excess c of healthy coils keeps to, and by how much a healthy current
/// misses its set-point: those of commissioning, wider since coils were given up or lost turns.
#include "fdd/commissioned/believed_turns.h"
#include "fdd/learning/commissioned_model.h"

namespace ambrig {

class ExcessBands {
 public:
  ExcessBands(const LinkageModel& nominal, const CommissionedBearing& learnt);

  /// The bands that follow from what is believed of the turns.
  void Set(const CommissionedBearing& learnt, const BelievedTurns& turns);

  /// Of |c|, a lane per window [-].
  const Lane (&of_windows() const)[kExcessWindows] { return band_; }
  double band(int window, int coil) const { return band_[window][coil]; }
  /// |set-point - mean| of a healthy current at most [A].
  const Lane& most_missed() const { return most_missed_; }
  /// Whether they are wider than commissioned.
  bool widened() const { return wider_ > 1; }

 private:
  /// How much what a coil has lost of its turns widens the bands: 1 from a great loss on, 0 without
  /// one.
  static double LossOf(double share);
  /// What a band of this coil is at least, because some coil has fewer turns than it had [-].
  double LeastBand(int coil, int window, const Lane& share) const;

  LinkageModel nominal_;
  Lane band_[kExcessWindows];
  Lane most_missed_;
  double wider_ = 1;
};

/// Whether both are windings of one thrust side (or one and the same).
inline bool SharesCore(const LinkageModel& m, int coil, int other) {
  return m.coupling == Coupling::kSides && coil / 2 == other / 2;
}

}  // namespace ambrig
