#pragma once
/// What a rig can do for a record, so that no plan asks for what it cannot: read from the records
/// that it has made, or stated for a rig without any.
#include <map>
#include <set>
#include <string>

#include "discovery/case/case.h"

namespace ambrig {

struct Abilities {
  bool levitate = false, clamp = false, burst = false, land = false, load = false,
       reference = false;
  double top_speed = 0;                                   // [rad/s], 0: the rig does not turn
  std::string coil_port;                                  // clamped: "current" or "duty"
  double coil_least = 0, coil_most = 0;                   // of that port, over the coils [A], [-]
  double burst_rate = 0, record_rate = 0;                 // [Hz]
  std::map<std::string, std::array<double, 2>> clamp_at;  // off centre, as a record had it [m]
  std::set<std::string> channels;  // that the logger writes; empty: all that are usual
};

/// What the records of a case show that the rig can do.
Abilities AbilitiesOf(const Case& c);

/// A rig whose rotor is levitated at rest and turned up to `top_speed` [rad/s]; `clamp`: it can be
/// held with load cells.
Abilities StatedAbilities(const RigParameters& rig, double top_speed, bool clamp);

}  // namespace ambrig
