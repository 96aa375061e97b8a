#pragma once
/// A look at the data before anything is fitted: missing samples, stuck or clipped channels, units
/// that cannot be, a time offset between logger and scenario.
#include <string>
#include <vector>

#include "core/record/record.h"

namespace ambrig {

struct ChannelQuality {
  std::string channel, verdict;  // "good", "stuck", "clipped", "missing samples", "empty"
  bool use = true;
  std::vector<char> ok;  // per row: counts in the error
  std::size_t missing = 0, clipped = 0;
};

/// `constant_allowed`: set-points of clamped runs, positions of a held rotor, a stiff bus may be
/// constant.
ChannelQuality InspectChannel(const Channel& channel, bool constant_allowed);

}  // namespace ambrig
