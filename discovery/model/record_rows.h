#pragma once
/// Values of a simulated record at the rows of a measured one: between two rows of the simulation
/// along a straight line.
#include <algorithm>
#include <span>
#include <vector>

#include "core/record/record.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Between which rows of a simulation, sampled with `rate` from t = 0, row `row` of `data` lies.
struct BetweenRows {
  std::size_t low = 0;
  double part = 0;  // of the way to the next; 0 where they differ by rounding only
};
inline BetweenRows PlaceOfRow(double rate, const Record& data, std::size_t row) {
  const double at = data.start * rate + static_cast<double>(row) * (rate / data.rate);
  const auto low = static_cast<std::size_t>(std::max(0.0, at + 1e-6));
  const double part = std::max(0.0, at - static_cast<double>(low));
  return {low, part < 1e-5 ? 0 : part};
}

/// Of a channel `y` between two rows; beyond its end the last one.
inline double Between(const std::vector<double>& y, const BetweenRows& p) {
  const std::size_t a = std::min(p.low, y.size() - 1), b = std::min(p.low + 1, y.size() - 1);
  return p.part == 0 ? y[a] : y[a] + p.part * (y[b] - y[a]);
}

/// Of a channel `y` that was sampled with `rate` from t = 0, at row `row` of `data`.
inline double AtRow(const std::vector<double>& y, double rate, const Record& data,
                    std::size_t row) {
  return Between(y, PlaceOfRow(rate, data, row));
}

/// Rate [Hz] of a simulation that is compared with `data`: the next one that the engine has. A
/// record that begins between two rows of that needs one a switching period.
double SimulationRateFor(const RigParameters& rig, const Record& data);

/// The rows of a simulation that AtRow reads for some rows of a measured record, so that the
/// simulation records no others (simulation/sampled/run_record.h).
class SimulatedRows {
 public:
  /// `rows`: of `data`, rising; `rate` [Hz] of the simulation.
  SimulatedRows(const Record& data, double rate, std::span<const std::size_t> rows);

  const std::vector<std::size_t>& needed() const { return needed_; }
  /// What AtRow gives at `rows[k]`, of a channel of which `needed` and the last row were recorded.
  double At(const std::vector<double>& y, std::size_t k) const { return Between(y, places_[k]); }

 private:
  std::vector<std::size_t> needed_;
  std::vector<BetweenRows> places_;  // among the needed ones
};

/// A copy of `data` whose channels hold what `simulated` says there; those that it lacks stay.
Record AtRowsOf(const Record& data, const Record& simulated);

}  // namespace ambrig
