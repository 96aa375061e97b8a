#pragma once
/// Values of a simulated record at the rows of a measured one: between two rows of the simulation
/// along a straight line.
#include <algorithm>
#include <vector>

#include "core/record/record.h"

namespace ambrig {

/// Of a channel `y` that was sampled with `rate` from t = 0, at row `row` of `data`. Beyond its end
/// the last one.
inline double AtRow(const std::vector<double>& y, double rate, const Record& data,
                    std::size_t row) {
  const double at = data.start * rate + static_cast<double>(row) * (rate / data.rate);
  const auto low = static_cast<std::size_t>(std::max(0.0, at + 1e-6));
  const double part = std::max(0.0, at - static_cast<double>(low));
  const std::size_t a = std::min(low, y.size() - 1), b = std::min(low + 1, y.size() - 1);
  return part < 1e-5 ? y[a] : y[a] + part * (y[b] - y[a]);
}

/// A copy of `data` whose channels hold what `simulated` says there; those that it lacks stay.
Record AtRowsOf(const Record& data, const Record& simulated);

}  // namespace ambrig
