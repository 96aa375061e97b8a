#include "simulation/verdict/run_watch.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

RunWatch::RunWatch(const SampledDataLoop& loop, RunResult& result)
    : loop_(loop),
      result_(result),
      contacts_(loop.plant.rotor, loop.scenario, loop.T),
      orbit_squared_(loop.bearings.size(), 0.0) {}

void RunWatch::Period(long long n) {
  if (loop_.clamped) return;
  const bool late = loop_.motion.t > 0.9 * loop_.scenario.duration;
  for (const SampledBearing& b : loop_.bearings) {
    const double squared = b.true_x * b.true_x + b.true_y * b.true_y;
    orbit_squared_[b.index] = std::max(orbit_squared_[b.index], squared);
    if (late) late_squared_ = std::max(late_squared_, squared);
  }
  contacts_.Period(loop_.motion, n == 0, result_);
}

void RunWatch::Finish() {
  RunMetrics& m = result_.metrics;
  if (!loop_.clamped)
    for (const SampledBearing& b : loop_.bearings)
      m.max_orbit[b.plant->name] = std::sqrt(orbit_squared_[b.index]);
  m.settled_orbit = std::sqrt(late_squared_);
  m.copper_loss = loop_.periods > 0 ? copper_sum_ / static_cast<double>(loop_.periods) : 0;
  contacts_.Finish(loop_.motion, result_);
}

}  // namespace ambrig
