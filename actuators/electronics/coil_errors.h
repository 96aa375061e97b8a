#pragma once
/// Errors of the single coils of one bearing that are known of this machine: measured ones,
/// or those that `ambrig adopt` found. The plant has them; controllers and detectors are not told.
#include <vector>

namespace ambrig {

struct CoilErrors {
  std::vector<double> current_gain;  // [-] of each current measurement, beside 1; empty: not known
  std::vector<double> edge;          // [s] by which each bridge switches late; empty: not known
  bool any() const { return !current_gain.empty() || !edge.empty(); }
};

}  // namespace ambrig
