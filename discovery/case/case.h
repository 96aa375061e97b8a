#pragma once
/// A case: measurements beside the model that should explain them. Source:
/// docs/guide/files.md.
#include <map>
#include <string>
#include <vector>

#include "core/record/record.h"
#include "discovery/data/data_quality.h"
#include "scenarios/scenario.h"

namespace ambrig {

struct CaseRecord {
  std::string scenario_file, data_file;
  Scenario scenario;
  Record data;  // rig channel names, SI
  bool validate = false;
  std::vector<ChannelQuality> quality;  // one per channel of data
};

struct Case {
  std::string file, rig_file;
  RigParameters rig;
  std::map<std::string, double> noise;  // rms by channel, SI
  std::vector<CaseRecord> records;
  std::vector<std::string> notes;  // what the data-quality pass left out
};

/// @throws InputError, one line, for anything that contradicts.
Case ReadCase(const std::string& path);

}  // namespace ambrig
