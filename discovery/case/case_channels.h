#pragma once
/// Columns of data files as channels of the rig: names, units, gains and delays that a case gives.
#include <map>
#include <string>

#include "core/base/toml.h"
#include "discovery/case/case.h"

namespace ambrig {

/// Channels a run of this rig has, with their SI unit.
std::map<std::string, std::string> KnownChannels(const RigParameters& rig);

/// What [record.channels] says of one channel.
struct ChannelMapping {
  std::string column, unit;
  double gain = 1;    // on top of the unit
  double offset = 0;  // added behind it [SI]
  double late = 0;    // [s] by which the column comes late
  bool use = true;
};

/// [record.channels] of one [[record]], by channel. @throws InputError
std::map<std::string, ChannelMapping> ReadMapping(const TomlTable& record,
                                                  const std::map<std::string, std::string>& known);

/// Columns renamed to rig channels, units converted; unknown columns are left out with a note in
/// `c`. `sources`: where each channel comes from. @throws InputError
Record MapChannels(const Record& raw, const std::map<std::string, ChannelMapping>& mapping,
                   const std::map<std::string, std::string>& known, const TomlTable& table, Case& c,
                   std::map<std::string, ColumnSource>& sources);

}  // namespace ambrig
