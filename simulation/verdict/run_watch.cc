#include "simulation/verdict/run_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rig/clearance.h"

namespace ambrig {

namespace {

constexpr const char* kInvalid = "model_invalid";

/// Said once: where the shaft is past a pole face there is no model, and nothing is a figure.
void PastThePoles(double t, const std::string& bearing, RunResult& result) {
  if (std::ranges::count(result.events, kInvalid, &RunEvent::kind) > 0) return;
  result.events.push_back({t, kInvalid, bearing, "", 0});
  result.notes.push_back(fmt::format(
      "past the poles of {} from t = {:.4f} s: the model is invalid after, orbits end at the gap",
      bearing, t));
}

/// Said once: the magnet is too far away to count on.
void Fallen(double t, const std::string& bearing, RunResult& result) {
  if (result.drop) return;
  result.drop = true;
  result.events.push_back({t, "drop", bearing, "", 0});
}

}  // namespace

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
    const double gap = b.plant->lanes.gap_offset[0];
    if (!(squared > gap * gap)) {
      Count(b, squared, late);
    } else if (InPole(loop_.rig.bearings[b.index], gap, b.true_x, b.true_y)) {
      PastThePoles(loop_.motion.t, b.plant->name, result_);
      orbit_squared_[b.index] = gap * gap;
      if (late) late_squared_ = std::max(late_squared_, gap * gap);
    } else {
      Count(b, squared, late);
      if (Uncaught()) Fallen(loop_.motion.t, b.plant->name, result_);
    }
  }
  contacts_.Period(loop_.motion, n == 0, result_);
}

bool RunWatch::Uncaught() const {
  return loop_.plant.rotor.auxiliaries().empty() && !loop_.plant.rotor.axial_stop();
}

void RunWatch::Count(const SampledBearing& b, double squared, bool late) {
  orbit_squared_[b.index] = std::max(orbit_squared_[b.index], squared);
  if (late) late_squared_ = std::max(late_squared_, squared);
}

void RunWatch::Finish() {
  RunMetrics& m = result_.metrics;
  if (!loop_.clamped)
    for (const SampledBearing& b : loop_.bearings)
      m.max_orbit[b.plant->name] = std::sqrt(orbit_squared_[b.index]);
  m.settled_orbit = std::sqrt(late_squared_);
  m.copper_loss = loop_.periods > 0 ? copper_sum_ / static_cast<double>(loop_.periods) : 0;
  contacts_.Finish(loop_.motion, result_);
  if (std::ranges::count(result_.events, kInvalid, &RunEvent::kind) == 0) return;
  // With nothing that could catch it, a shaft at the poles has fallen.
  if (Uncaught()) result_.drop = true;
  // No deeper than where an orbit ends: at the pole faces.
  double deepest = 0;
  for (const SampledBearing& b : loop_.bearings)
    if (const BearingParameters* p = loop_.rig.Find(b.plant->name))
      deepest = std::max(deepest, std::sqrt(orbit_squared_[b.index]) - ClearanceOf(*p));
  m.min_clearance_left = std::max(m.min_clearance_left, -deepest);
}

}  // namespace ambrig
