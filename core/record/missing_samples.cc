#include "core/record/missing_samples.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

/// Row of the first finite sample from `row` on; the number of rows when there is none.
std::size_t NextFinite(const std::vector<double>& y, std::size_t row) {
  while (row < y.size() && !std::isfinite(y[row])) ++row;
  return row;
}

void BridgeOne(std::vector<double>& y, std::vector<char>& gap) {
  for (std::size_t k = 0; k < y.size(); ++k) {
    if (std::isfinite(y[k])) continue;
    const std::size_t end = NextFinite(y, k), length = end - k + 1;
    const double from = k > 0 ? y[k - 1] : y[end], to = end < y.size() ? y[end] : from;
    for (std::size_t n = k; n < end; ++n) {
      y[n] = from + (to - from) * static_cast<double>(n - k + 1) / static_cast<double>(length);
      gap[n] = 1;
    }
    k = end;
  }
}

bool AnyMissing(const Channel& c) {
  return !std::all_of(c.samples.begin(), c.samples.end(),
                      [](double v) { return std::isfinite(v); });
}

}  // namespace

BridgedRecord BridgeMissing(const Record& record, double after,
                            const std::function<bool(const std::string& name)>& drives) {
  BridgedRecord out{record, {}};
  std::vector<Channel>& channels = out.record.channels;
  if (std::none_of(channels.begin(), channels.end(), AnyMissing)) return out;
  const std::size_t rows = record.rows();
  std::erase_if(channels,
                [&](const Channel& c) { return rows > 0 && NextFinite(c.samples, 0) == rows; });
  out.in_gap.assign(rows, 0);
  std::vector<char> ignored(rows, 0);
  for (Channel& c : channels) BridgeOne(c.samples, drives(c.name) ? out.in_gap : ignored);
  const auto felt = static_cast<std::size_t>(after * record.rate);
  std::size_t left = 0;  // rows behind the last gap
  for (char& row : out.in_gap) {
    if (row != 0) {
      left = felt;
    } else if (left > 0) {
      row = 1;
      --left;
    }
  }
  return out;
}

}  // namespace ambrig
