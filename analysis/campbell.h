#pragma once
/// Closed-loop Campbell diagram: modes over speed, followed from speed to speed by frequency,
/// damping and shape, and where a rotor mode meets the speed itself (critical speeds, damped).
#include <cmath>

#include "analysis/closed_loop_modes.h"

namespace ambrig {

/// One mode over the speeds at which it was found.
struct ModeTrack {
  std::vector<double> speed;          // [rad/s]
  std::vector<ClosedLoopMode> modes;  // same size
  bool of_rotor() const;              // by its mean share
  Whirl sense() const;                // at its highest speed
};

struct DampedCritical {
  double speed = 0;     // [rad/s], where the damped frequency equals it
  ClosedLoopMode mode;  // at the nearest speed
  /// Whether a response has a peak there: without one it is no critical speed to a reader.
  bool IsResonance() const { return mode.zeta < std::sqrt(0.5); }
};

/// `rows` by rising speed.
std::vector<ModeTrack> FollowModes(const std::vector<ClosedLoopModes>& rows);
/// Of the rotor's tracks, rising.
std::vector<DampedCritical> FindCriticals(const std::vector<ModeTrack>& tracks);

}  // namespace ambrig
