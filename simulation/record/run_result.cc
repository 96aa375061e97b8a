#include "simulation/record/run_result.h"

namespace ambrig {

void AddSummary(const Supervisor* supervisor, RunResult& result) {
  if (!supervisor) return;
  SupervisorSummary summary = supervisor->Summary();
  result.metrics.coil_periods = summary.coil_periods;
  result.slopes = std::move(summary.slopes);
  result.actions = std::move(summary.actions);
  result.doubtful = summary.doubtful;
  result.doubtful_share = std::move(summary.doubtful_share);
  result.interfered = summary.interfered;
}

}  // namespace ambrig
