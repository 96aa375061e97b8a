/// Rows of a simulation that are read for some rows of a measured record give what a whole record
/// gives.
#include "discovery/model/record_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace ambrig {
namespace {

constexpr std::size_t kSimulated = 50;  // rows

Record Data(double rate, double start) {
  Record data;
  data.rate = rate;
  data.start = start;
  return data;
}

/// What RunRecord keeps of a channel.
std::vector<double> Kept(const std::vector<double>& y, const std::vector<std::size_t>& needed) {
  std::vector<double> kept;
  for (std::size_t k = 0; k < y.size(); ++k)
    if (k + 1 == y.size() || std::ranges::find(needed, k) != needed.end()) kept.push_back(y[k]);
  return kept;
}

void ExpectTheSame(const Record& data, double rate, const std::vector<std::size_t>& rows) {
  std::vector<double> y(kSimulated);
  for (std::size_t k = 0; k < y.size(); ++k) y[k] = std::sin(static_cast<double>(k * k));
  const SimulatedRows simulated(data, rate, rows);
  const std::vector<double> kept = Kept(y, simulated.needed());
  for (std::size_t k = 0; k < rows.size(); ++k)
    EXPECT_EQ(simulated.At(kept, k), AtRow(y, rate, data, rows[k])) << "row " << rows[k];
}

std::vector<std::size_t> Every(std::size_t step, std::size_t count) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k * step < count; ++k) rows.push_back(k * step + k % step);
  return rows;
}

TEST(SimulatedRows, AsOfAWholeRecord) {
  for (const std::size_t step : {1, 3, 7})
    for (const double start : {0.0, -2e-4, 3.3e-4, 1e-3}) {
      ExpectTheSame(Data(10e3, start), 10e3, Every(step, 60));    // the same clock; beyond the end
      ExpectTheSame(Data(9000, start), 12.5e3, Every(step, 60));  // between rows
      ExpectTheSame(Data(25e3, start), 10e3, Every(step, 60));    // several between two rows
    }
}

TEST(SimulatedRows, ThoseOfAThinnedRecordOnly) {
  EXPECT_EQ(SimulatedRows(Data(10e3, 0), 10e3, Every(7, 49)).needed(), Every(7, 49));
  EXPECT_TRUE(SimulatedRows(Data(10e3, 0), 10e3, {}).needed().empty());
}

}  // namespace
}  // namespace ambrig
