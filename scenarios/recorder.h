#pragma once
/// Collects the channels of a run on its uniform time base. Source: shared/design/formats.md "Record".
#include <string>
#include <vector>

#include "core/record/record.h"

namespace ambrig {

class Recorder {
 public:
  Recorder(double rate, double start) {
    record_.rate = rate;
    record_.start = start;
  }
  /// Adds a channel; returns its index for Put.
  std::size_t Add(const std::string& name, const std::string& unit, std::size_t rows) {
    record_.channels.push_back({name, unit, {}});
    record_.channels.back().samples.reserve(rows);
    return record_.channels.size() - 1;
  }
  void Put(std::size_t channel, double value) { record_.channels[channel].samples.push_back(value); }
  Record Take() { return std::move(record_); }

 private:
  Record record_;
};

}  // namespace ambrig
