#pragma once
/// Whether a rig survives a record: simulated with noise, for every model that may be true.
#include <string>

#include "discovery/plan/rivals.h"

namespace ambrig {

struct SafetyLimits {
  double orbit = 0.6;       // of the clearance of each bearing
  double current = 0.95;    // of i_max
  double saturation = 0.1;  // share of the samples of a coil whose duty stands at a limit
};

struct SafetyResult {
  bool safe = false;
  double largest_orbit = 0;    // [m], of the levitated rotor's readings
  std::string orbit_at = {};   // the bearing that shows it
  double orbit_share = 0;      // [-] of any bearing's orbit, of what is allowed there
  double largest_current = 0;  // [A]
  std::string reason;          // why not
};

SafetyResult CheckSafety(const TrialRecord& trial, const Rival& rival, const SafetyLimits& limits);

}  // namespace ambrig
