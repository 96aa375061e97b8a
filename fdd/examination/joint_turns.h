#pragma once
/// What is left of the turns of every coil of a bearing, all coils together. The relative excess c
/// of a coil (slope_excess.h) is right for the one coil that has failed: the flux of every pole
/// depends on the ampere-turns of all, so that coils that lost turns at one instant move the c of
/// each other and of healthy neighbours, by as much as 1. Here the shares a_j are unknowns of one
/// system,
///
///   c_j(a) = 0   for every coil whose current is known,
///
/// solved by Newton's method over the last periods, with fluxes computed again for each trial from
/// the state that the circuit had before the first of them. A coil without current (open, bridge
/// off) adds no ampere-turns whatever its a, so that shorts are found beside it.
///
/// The two windings of a thrust side carry one flux, and the system of a side is quadratic with two
/// solutions: half of the turns of one winding give the slopes of 62 % and 49 % of both
/// (reference rig). The winding that explains its side alone is taken to be the one that failed,
/// and the other one keeps its turns.
///
/// No explanation: a share above 1 (the reading of the current is false), or phases that contradict
/// each other (a bridge that does not follow its command).
#include <array>
#include <optional>

#include "fdd/circuit/slope_excess.h"
#include "fdd/measurement/kept_period.h"

namespace ambrig {

struct JointShares {
  Lane left;  // of the turns of every coil [-]
  /// How far an error of 1 in the c of every coil may move the share, relative to the turns
  /// believed [-]. Coils of one polarity that have lost turns move the rotor's potential, and the
  /// shares of all others hang on that potential alone: half a share of a single coil
  /// becomes three shares.
  Lane per_excess;
};

class JointTurns {
 public:
  /// Periods kept: the first one holds the onset and only sets the circuit's state.
  static constexpr int kKept = 3;

  /// One period; `before`: state of the circuit at its start.
  void Keep(const MeasuredPeriod& in, int samples, const FluxFilter::State& before);
  /// Nothing of the past is kept.
  void Clear() { count_ = 0; }

  /// Shares of the turns that the last periods ask for. `filter`: of the bearing, with the turns
  /// that are believed; `believed`: those turns, 0: not judged; `dead`: coils
  /// without current, as 1.
  std::optional<JointShares> Solve(const FluxFilter& filter, const CoilEquations& coils,
                                   const ExcessSettings& settings, const Lane& believed,
                                   const Lane& dead) const;

 private:
  std::array<KeptPeriod, kKept> period_;
  std::array<FluxFilter::State, kKept> before_;
  long long count_ = 0;
};

}  // namespace ambrig
