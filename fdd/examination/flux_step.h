#pragma once
/// Whether the flux of a pole left with the turns that its coil has lost. The ripple cannot tell
/// turns that are bypassed from a few that close through a resistance: such a loop carries the
/// current that keeps the ripple's flux out of the pole, and the slopes are those of half of the
/// turns whatever its size is. At the currents that carry the shaft a loop of few turns does
/// nothing. What differs is the instant of the fault:
///
///   bypassed   the flux stays for that instant, so that the current of the turns that are left
///              steps to i/(1 - s), and the regulator has to take it back with volt-seconds
///   a loop     carries on the current that its turns had: no step; the flux follows the loop's own
///              time constant
///
/// With the linkage lambda(i) of the healthy coil by its measured currents, and its slope over that
/// of the volt-seconds W, a before and b after the instant, the step is
///
///   J = lambda - lambda* - b (W - W*) = f b s (1 - s) lambda*,   0 at first for a loop;
///
/// f: part of the inductance at the ripple that is not leakage, whose linkage stays, too. Of a
/// winding of a thrust side J is less by the share that it has of the ampere-turns of its side. A
/// loop keeps the ripple's flux from both windings there, so that the slopes of both are those of
/// windings that have lost half of their turns.
///
/// The instant is the one at which two straight lines over W leave the least error.
#include <array>
#include <optional>

#include "fdd/measurement/kept_period.h"

namespace ambrig {

class FluxStep {
 public:
  FluxStep(const LinkageModel& nominal, const SamplingSettings& sampling);

  void Keep(const MeasuredPeriod& in);
  void Clear() { count_ = 0; }

  /// Share of the turns without which the coil's flux is, of a coil that has lost `by_ripple` of
  /// them by its slopes: about `by_ripple` where they are bypassed, less for a loop. `onset`: start
  /// of the first period that looked faulty [s]. `of_both`: both windings of a thrust side are
  /// taken to have lost as many, so that both step. Nothing where too little is known.
  std::optional<double> Lost(int coil, double onset, double by_ripple, bool of_both) const;

 private:
  static constexpr int kKept = 12;
  struct Curve;  // linkage and volt-seconds of one coil, sample by sample
  Curve CurveOf(int coil) const;
  /// Part of the coil's inductance at the ripple that is not its leakage; `a`: as above.
  double Follows(int coil, double a) const;

  LinkageModel nominal_;
  SamplingSettings sampling_;
  std::array<KeptPeriod, kKept> period_;
  long long count_ = 0;
};

}  // namespace ambrig
