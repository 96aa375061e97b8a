#pragma once
/// Records that a rig could make next: multisines in several bands and sizes, steps, run-ups only
/// where the rig turns, lift-off, ramps and pulses of the coil currents with the rotor held.
#include <functional>
#include <string>
#include <vector>

#include "discovery/experiment/examination.h"
#include "discovery/plan/abilities.h"

namespace ambrig {

struct PlanCandidate {
  std::string title, what;  // `what`: for the card, in words
  bool clamped = false, burst = false;
  double duration = 0;  // [s]
  /// The scenario file at a share of the usual size of its excitation.
  std::function<std::string(double size)> toml;
};

/// About 20 for a rig that can do everything; only what `abilities` allow. `seed`: phases.
std::vector<PlanCandidate> PlanCandidates(const RigParameters& rig, const Abilities& abilities,
                                          std::uint64_t seed);

}  // namespace ambrig
