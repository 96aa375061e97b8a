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

Case WithClocks(const Case& c, const std::vector<double>& late) {
  constexpr double kWhole = 1e-6;  // of a row: rounding
  Case out = c;
  for (std::size_t r = 0; r < out.records.size() && r < late.size(); ++r) {
    CaseRecord& record = out.records[r];
    if (late[r] == 0) continue;
    // No row shall lie before the record's start.
    const double exact = late[r] * record.data.rate, rows = std::ceil(exact - kWhole);
    if (rows - exact > kWhole) record.data.start += (rows - exact) / record.data.rate;
    for (Channel& channel : record.data.channels)
      MoveBack(channel.samples, static_cast<int>(rows), std::numeric_limits<double>::quiet_NaN());
    for (ChannelQuality& quality : record.quality)
      MoveBack(quality.ok, static_cast<int>(rows), decltype(quality.ok)::value_type(0));
  }
  return out;
}

}  // namespace ambrig
