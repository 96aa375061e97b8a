#pragma once
/// Channels and properties of TDMS files ("TDMS File Format Internal Structure", National
/// Instruments): segments, each with a list of objects and their raw data behind it.
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace ambrig {

/// Integers, floats, truth values and times (seconds since 1904) as double.
using TdmsValue = std::variant<double, std::string>;

struct TdmsChannel {
  std::string group, name;
  std::map<std::string, TdmsValue> properties;
  std::vector<double> samples;
  bool text = false;        // strings, which are not kept
  bool timestamps = false;  // samples in s from the first on

  /// nullptr when absent or of the other type.
  const double* Number(const std::string& property) const;
  const std::string* Text(const std::string& property) const;
};

/// In the order in which the file names them; groups and the file itself are left out.
/// @throws InputError "PATH: byte N: ...", also for DAQmx raw data
std::vector<TdmsChannel> ReadTdmsChannels(const std::string& path, std::string_view bytes);

}  // namespace ambrig
