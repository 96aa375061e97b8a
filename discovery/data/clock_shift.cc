#include "discovery/data/clock_shift.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace ambrig {

namespace {

/// values[k] becomes values[k + late]; the rows at the end to which nothing comes hold `nothing`.
template <class T>
void MoveBack(std::vector<T>& values, int late, T nothing) {
  const auto rows = static_cast<std::ptrdiff_t>(
      std::min<std::size_t>(static_cast<std::size_t>(std::abs(late)), values.size()));
  if (late > 0) {
    std::move(values.begin() + rows, values.end(), values.begin());
    std::fill(values.end() - rows, values.end(), nothing);
  } else {
    std::move_backward(values.begin(), values.end() - rows, values.end());
    std::fill(values.begin(), values.begin() + rows, nothing);
  }
}

}  // namespace

long MostRowsOff(double rate) { return std::max(kMostRowsOff, std::lround(kMostClockOff * rate)); }

Case WithClocks(const Case& c, const std::vector<int>& rows_late) {
  Case out = c;
  for (std::size_t r = 0; r < out.records.size() && r < rows_late.size(); ++r) {
    CaseRecord& record = out.records[r];
    if (rows_late[r] == 0) continue;
    for (Channel& channel : record.data.channels)
      MoveBack(channel.samples, rows_late[r], std::numeric_limits<double>::quiet_NaN());
    for (ChannelQuality& quality : record.quality)
      MoveBack(quality.ok, rows_late[r], decltype(quality.ok)::value_type(0));
  }
  return out;
}

}  // namespace ambrig
