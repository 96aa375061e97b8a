#include "simulation/continuous/run_watch.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

RunWatch::RunWatch(const SampledRig& rig, RunResult& result)
    : rig_(rig), result_(result), contacts_(rig.plant.rotor, rig.scenario, rig.T) {}

void RunWatch::Period(long long n, double copper, double peak_current) {
  if (n < 0) return;
  RunMetrics& m = result_.metrics;
  copper_sum_ += copper;
  m.peak_current = std::max(m.peak_current, peak_current);
  if (rig_.clamped) return;
  for (const SampledBearing& b : rig_.bearings) {
    const double orbit = std::hypot(b.true_x, b.true_y);
    double& most = m.max_orbit[b.plant->name];
    most = std::max(most, orbit);
    if (rig_.motion.t > 0.9 * rig_.scenario.duration)
      m.settled_orbit = std::max(m.settled_orbit, orbit);
  }
  contacts_.Period(rig_.motion, n == 0, result_);
}

void RunWatch::Finish() {
  RunMetrics& m = result_.metrics;
  m.copper_loss = rig_.periods > 0 ? copper_sum_ / static_cast<double>(rig_.periods) : 0;
  contacts_.Finish(rig_.motion, result_);
}

}  // namespace ambrig
