#pragma once
/// Stored records of scenarios, small enough for a git repository: chosen channels, every n-th row,
/// single precision, with the events and where they come from inside.
#include <string>
#include <vector>

#include "app/json/difference_json.h"
#include "simulation/record/run_result.h"

namespace ambrig {

struct BaselineOptions {
  std::string folder;                 // empty: no baselines
  std::vector<std::string> channels;  // patterns with one *; empty: readings, currents, speed, bus
  std::size_t rows = 1000;            // at most
  bool accept = false;
};

/// FOLDER/NAME.baseline.h5 of a scenario file: its path, relative where it can be, with __ for /.
std::string BaselineFile(const BaselineOptions& o, const std::string& scenario_file);

/// What is kept of a run. `provenance`: attributes such as the texts of scenario and rig.
Record BaselineRecord(const BaselineOptions& o, const RunFiles& run,
                      const std::map<std::string, std::string>& provenance);

/// @throws InputError when it is missing or not a baseline.
RunFiles ReadBaseline(const std::string& file);

/// FOLDER/tolerances.toml, else a millionth of each channel's largest value (single precision has
/// 6e-8) and events at the same instants.
RecordTolerances BaselineTolerances(const BaselineOptions& o);

/// A tolerance that fits no channel of any baseline of the folder is misspelt. @throws InputError
void RequireTolerancesFit(const BaselineOptions& options);

/// The stored record beside the new one, channels that the baseline has.
RunDifference CompareToBaseline(const RunFiles& baseline, const RunFiles& now,
                                const RecordTolerances& t);

}  // namespace ambrig
