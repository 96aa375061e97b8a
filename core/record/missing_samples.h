#pragma once
/// Samples that a logger lost (NaN, infinite): bridged where a measured channel drives a
/// computation, which one NaN would end.
#include <functional>
#include <string>
#include <vector>

#include "core/record/record.h"

namespace ambrig {

struct BridgedRecord {
  // straight lines over the gaps, the ends held; a channel without any sample is left out
  Record record;
  // one per row: 1 where a channel that drives has a gap, and for `after` behind it; empty: nothing
  // is missing
  std::vector<char> in_gap;

  bool Sound(std::size_t row) const { return in_gap.empty() || in_gap[row] == 0; }
};

/// `after` [s]: how long what was bridged may still be felt. `drives`: names of the channels whose
/// gaps matter.
BridgedRecord BridgeMissing(const Record& record, double after,
                            const std::function<bool(const std::string& name)>& drives);

}  // namespace ambrig
