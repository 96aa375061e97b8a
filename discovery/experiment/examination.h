#pragma once
/// Records that a rig can make to be examined: excitations of everything that a model may have
/// wrong.
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "discovery/case/case.h"

namespace ambrig {

struct ExaminationRecord {
  std::string title, toml;  // of the scenario, rig = "rig.toml"
  bool validate = false;
  bool burst = false;  // at the rate of the amplifiers' converters
};

/// What only some effects show.
struct ExaminationNeeds {
  bool contact = false;     // lift-off from the auxiliary bearings
  bool free_speed = false;  // coast-down with the drive off
};

/// Multisines at rest and at two speeds, run-up, steps of reference and load, clamped current ramps
/// and pulses; sizes follow the rotor's weight and the clearances. `seed` draws phases, places and
/// sizes.
std::vector<ExaminationRecord> Examination(const RigParameters& rig, std::uint64_t seed,
                                           const ExaminationNeeds& needs = {});

/// A case of such records with empty data (zeros) in the channels that a logger would have:
/// readings, currents, set-points, bus, load cells where clamped.
Case EmptyCase(const RigParameters& rig, const std::vector<ExaminationRecord>& records);

/// Leaves out the channels of the record that are not among these names.
void KeepChannels(CaseRecord& record, const std::set<std::string>& names);

}  // namespace ambrig
