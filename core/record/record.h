#pragma once
/// A record: channels on one uniform time base. What a run writes and what a rig's data logger
/// wrote are the same thing (docs/guide/files.md, docs/guide/channel_names.md).
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ambrig {

struct Channel {
  std::string name;  // "A.x", "A.i1", "bus" ...
  std::string unit;  // SI inside
  std::vector<double> samples;
};

struct Record {
  double rate = 0;   // [Hz]
  double start = 0;  // [s], time of the first row
  std::vector<Channel> channels = {};
  std::map<std::string, std::string> attributes = {};  // of the whole record, e.g. its parameters
  std::vector<std::string> notes = {};  // what a reader left out, one line each; never written
  // Times [s] of the last row before and the first behind each block of rows that a
  // reader found missing.
  std::vector<std::pair<double, double>> gaps = {};

  std::size_t rows() const { return channels.empty() ? 0 : channels.front().samples.size(); }
  double TimeAt(std::size_t row) const { return start + static_cast<double>(row) / rate; }
  /// nullptr when absent.
  const Channel* Find(std::string_view name) const {
    for (const Channel& c : channels)
      if (c.name == name) return &c;
    return nullptr;
  }
};

}  // namespace ambrig
