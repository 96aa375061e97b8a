#include "discovery/data_gate/lost_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "discovery/data/clock_shift.h"

namespace ambrig {

namespace {

constexpr double kLongestLoss = 0.05;  // [s], of all blocks together
constexpr double kMostCells = 5e7;     // rows times clocks that are kept
constexpr double kBlockPays = 0.005;   // of the squared error: what a block has to explain
constexpr std::uint16_t kNoBlock = 65535;

/// Squared errors of the program with commands that come so many rows early.
class EarlyCommands {
 public:
  explicit EarlyCommands(const CommandReplay& replay) : silent_(replay.silent), now_(replay.now) {}

  std::size_t rows() const { return silent_.empty() ? 0 : silent_[0].error.size(); }

  /// Of all axes in one row [A²]; nothing in the controller depends on time, so that its answer
  /// moves with the commands.
  double Square(std::size_t row, long early) const {
    const long at = std::clamp(static_cast<long>(row) + early, 0L, static_cast<long>(rows()) - 1);
    double sum = 0;
    for (std::size_t a = 0; a < silent_.size(); ++a) {
      if (!silent_[a].counts[row]) continue;
      const auto from = static_cast<std::size_t>(at);
      const double error = silent_[a].error[row] + now_[a].error[from] - silent_[a].error[from];
      sum += error * error;
    }
    return sum;
  }

 private:
  const std::vector<ControllerAxis>&silent_, &now_;  // without commands, with them
};

/// The clocks of all rows with the least cost, which never go back. `clock` 0 is `first` rows
/// early.
struct ClockPath {
  std::vector<long> early;  // of each row [rows]
  double cost = 0;          // squared error without the price of the blocks [A²]
};

/// Dynamic programming over rows and clocks.
ClockPath BestClocks(const EarlyCommands& commands, long first, std::size_t clocks, double price) {
  const std::size_t rows = commands.rows();
  std::vector<double> cost(clocks), before(clocks);
  std::vector<std::uint16_t> from(rows * clocks, kNoBlock);
  const auto square = [&](std::size_t row, std::size_t clock) {
    return commands.Square(row, first + static_cast<long>(clock));
  };
  for (std::size_t row = 0; row < rows; ++row) {
    before = cost;
    std::size_t least = 0;  // of the clocks before this one
    for (std::size_t clock = 0; clock < clocks; ++clock) {
      cost[clock] = before[clock];
      if (row > 0 && clock > 0 && before[least] + price < cost[clock]) {
        cost[clock] = before[least] + price;
        from[row * clocks + clock] = static_cast<std::uint16_t>(least);
      }
      if (before[clock] < before[least]) least = clock;
      cost[clock] += square(row, clock);
    }
  }
  ClockPath out{std::vector<long>(rows), 0};
  auto clock = static_cast<std::size_t>(std::ranges::min_element(cost) - cost.begin());
  for (std::size_t row = rows; row-- > 0;) {
    out.early[row] = first + static_cast<long>(clock);
    out.cost += square(row, clock);
    if (const std::uint16_t was = from[row * clocks + clock]; was != kNoBlock) clock = was;
  }
  return out;
}

}  // namespace

LostBlocks FindLostBlocks(const CommandReplay& replay, double rate) {
  LostBlocks out;
  const EarlyCommands commands(replay);
  const std::size_t rows = commands.rows();
  double as_it_is = 0;
  for (std::size_t row = 0; row < rows; ++row) as_it_is += commands.Square(row, 0);
  if (as_it_is <= 0) return out;
  const long off = MostRowsOff(rate);
  const double longest = std::min({kLongestLoss * rate, kMostCells / static_cast<double>(rows),
                                   static_cast<double>(kNoBlock) - 1});
  const auto clocks = static_cast<std::size_t>(2 * off + 1 + std::lround(longest));
  const ClockPath path = BestClocks(commands, -off, clocks, kBlockPays * as_it_is);
  for (std::size_t row = 1; row < rows; ++row)
    if (path.early[row] > path.early[row - 1])
      out.blocks.push_back({row, static_cast<std::size_t>(path.early[row] - path.early[row - 1])});
  out.left = std::sqrt(path.cost / as_it_is);
  return out;
}

}  // namespace ambrig
