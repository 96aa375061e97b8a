#include "discovery/case/data_quality.h"
#include "core/base/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

/// Rows at the channel's own extreme that stand in runs of four or more: a clipped signal.
std::size_t MarkClipped(const std::vector<double>& y, double extreme, std::vector<char>& ok) {
  std::size_t clipped = 0;
  for (std::size_t k = 0; k < y.size();) {
    std::size_t end = k;
    while (end < y.size() && y[end] == extreme) ++end;
    if (end - k >= 4) {
      clipped += end - k;
      for (std::size_t m = k; m < end; ++m) ok[m] = 0;
    }
    k = std::max(end, k + 1);
  }
  return clipped;
}

}  // namespace

ChannelQuality InspectChannel(const Channel& channel, bool constant_allowed) {
  ChannelQuality q;
  q.channel = channel.name;
  const std::vector<double>& y = channel.samples;
  q.ok.assign(y.size(), 1);
  double low = 0, high = 0;
  bool first = true;
  for (std::size_t k = 0; k < y.size(); ++k) {
    if (!std::isfinite(y[k])) {
      q.ok[k] = 0;
      ++q.missing;
      continue;
    }
    low = first ? y[k] : std::min(low, y[k]);
    high = first ? y[k] : std::max(high, y[k]);
    first = false;
  }
  if (q.missing == y.size()) {
    q.use = false;
    q.verdict = "empty: no finite sample";
    return q;
  }
  if (high == low) {
    q.use = constant_allowed;
    q.verdict = constant_allowed ? "good (constant)" : fmt::format("stuck at {}: left out", low);
    return q;
  }
  if (!constant_allowed) {
    // A quantised signal repeats values anywhere; clipping repeats the extremes only.
    const std::size_t top = MarkClipped(y, high, q.ok), bottom = MarkClipped(y, low, q.ok);
    if (top + bottom > y.size() / 200) {
      q.clipped = top + bottom;
    } else {
      for (std::size_t k = 0; k < y.size(); ++k) q.ok[k] = std::isfinite(y[k]) ? 1 : 0;
    }
  }
  std::string faults;
  if (q.missing > 0) faults = Counted(q.missing, "sample") + " missing";
  if (q.clipped > 0)
    faults += (faults.empty() ? "" : ", ") + ("clipped in " + Counted(q.clipped, "sample"));
  q.verdict = faults.empty() ? "good" : faults + ", left out";
  return q;
}

}  // namespace ambrig
