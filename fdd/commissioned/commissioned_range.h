#pragma once
/// Whether the flux of every coil is within the range that was commissioned, and from which c on a
/// coil is gross accordingly.
///
/// Lost turns make the flux that is computed too large, and that alone takes a coil
/// outside which was near the end of its range: where it leaves the range with a jump that no
/// voltage makes, the range is wider by that jump for the next 250 periods. Iron that saturates
/// makes no jump.
#include "fdd/commissioned/believed_turns.h"
#include "fdd/commissioned/jump_watch.h"
#include "fdd/learning/commissioned_model.h"

namespace ambrig {

class CommissionedRange {
 public:
  CommissionedRange(const LinkageModel& nominal, const CommissionedBearing& learnt);

  /// One period, the `count`th.
  void Update(const FluxPeriod& flux, const SlopeExcess& excess, const JumpWatch& jumps,
              const BelievedTurns& turns, long long count);
  /// What the flux was before says nothing of the next period.
  void Forget() { last_flux_ = Lane{}; }

  /// Whether some coil was outside in the last period.
  bool left() const { return left_; }
  /// c > 0 that is gross, of every coil in the last period [-].
  const Lane& gross_above() const { return gross_above_; }

 private:
  /// Whether a coil whose flux is beyond what was commissioned is outside the range of the model:
  /// not where lost turns account for it.
  bool Leaves(int coil, double flux, bool jumps, long long count);

  int coils_;
  bool learnt_;
  Lane largest_flux_;  // of commissioning [A]
  Lane sudden_;        // c of one period that iron does not make as a coil leaves [-]
  Lane last_flux_;     // largest of the period before [A]
  Lane wider_;         // range where lost turns account for more flux [A]
  long long wider_until_[kLanes] = {};  // period up to which that holds
  Lane gross_above_;
  bool left_ = false;
};

}  // namespace ambrig
