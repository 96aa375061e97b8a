#include "discovery/model/record_rows.h"

#include <cmath>

#include "core/base/errors.h"
#include "rig/rig_figures.h"

namespace ambrig {

double SimulationRateFor(const RigParameters& rig, const Record& data) {
  const double rate = RecordRateFor(rig, data.rate), begin = data.start * rate;
  if (std::abs(begin - std::round(begin)) < 1e-5) return rate;
  return std::max(rate, RecordRateFor(rig, rig.amplifier.switching_frequency));
}

SimulatedRows::SimulatedRows(const Record& data, double rate, std::span<const std::size_t> rows) {
  const auto place_of =
      [this](std::size_t row) {  // the rows rise: it is one of the last two, or new
        const std::size_t count = needed_.size();
        for (std::size_t back = 1; back <= std::min<std::size_t>(count, 2); ++back)
          if (needed_[count - back] == row) return count - back;
        Require(count == 0 || needed_.back() < row, "rows that rise");
        needed_.push_back(row);
        return count;
      };
  for (const std::size_t row : rows) {
    const BetweenRows p = PlaceOfRow(rate, data, row);
    places_.push_back({place_of(p.low), p.part});
    if (p.part > 0) place_of(p.low + 1);
  }
}

Record AtRowsOf(const Record& data, const Record& simulated) {
  Record out = data;
  for (Channel& c : out.channels) {
    const Channel* from = simulated.Find(c.name);
    if (!from || from->samples.empty()) continue;
    for (std::size_t k = 0; k < c.samples.size(); ++k)
      c.samples[k] = AtRow(from->samples, simulated.rate, data, k);
  }
  return out;
}

}  // namespace ambrig
