/// What FaultSupervisor keeps for the record of a run: slopes round the first alarm, its summary.
#include <algorithm>

#include "core/base/coil_name.h"
#include "faulttolerance/supervision/fault_supervisor.h"
#include "faulttolerance/supervision/watched_bearing.h"

namespace ambrig {

namespace {
constexpr double kTraceBefore = 5e-3, kTraceAfter = 10e-3;  // [s]
}

void FaultSupervisor::TraceSlopes(double t) {
  if (first_alarm_ >= 0 && t > first_alarm_ + kTraceAfter) return;
  // A row that has become too old lends its memory to the new one.
  SlopeRow row;
  if (first_alarm_ < 0 && !rows_.empty() && rows_.front().t < t - kTraceBefore) {
    row = std::move(rows_.front());
    rows_.pop_front();
    row.bearings.clear();
  }
  row.t = t;
  for (const auto& w : watched_) {
    std::array<Lane, 3> lanes{};
    for (int j = 0; j < w->bearing->coils(); ++j) {
      const SlopeBand band = w->detector->Band(j);
      lanes[0][j] = band.slope;
      lanes[1][j] = band.expected;
      lanes[2][j] = band.half_width;
    }
    row.bearings.push_back(lanes);
  }
  rows_.push_back(std::move(row));
  while (first_alarm_ < 0 && rows_.front().t < t - kTraceBefore) rows_.pop_front();
}

SlopeBand FaultSupervisor::Band(std::size_t bearing, int coil) const {
  return watched_[bearing]->detector->Band(coil);
}

SupervisorSummary FaultSupervisor::Summary() const {
  SupervisorSummary summary;
  summary.coil_periods = coil_periods_;
  summary.actions = actions_;
  summary.doubtful = doubtful_;
  for (const std::unique_ptr<Watched>& w : watched_)
    if (w->periods > 0) summary.doubtful_share[w->bearing->name] = w->doubtful_periods / w->periods;
  summary.interfered = interfered_;
  if (!options_.slopes || rows_.empty()) return summary;
  const Watched& w = *watched_[alarm_bearing_];
  const int coils = w.bearing->coils();
  std::vector<int> shown;
  for (int step : {0, 1, coils - 1, coils / 2}) {
    const int j = (alarm_coil_ + step) % coils;
    if (std::find(shown.begin(), shown.end(), j) == shown.end()) shown.push_back(j);
  }
  for (int j : shown) {
    SlopeTrace trace;
    trace.coil = CoilName(w.bearing->name, j);
    for (const SlopeRow& row : rows_) {
      const std::array<Lane, 3>& a = row.bearings[w.index];
      trace.t.push_back(row.t);
      trace.slope.push_back(a[0][j]);
      trace.low.push_back(a[1][j] - a[2][j]);
      trace.high.push_back(a[1][j] + a[2][j]);
    }
    summary.slopes.push_back(std::move(trace));
  }
  return summary;
}

}  // namespace ambrig
