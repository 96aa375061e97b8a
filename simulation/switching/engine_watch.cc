/// Events and figures of a run: orbit, contact, touchdown, drop, currents, copper loss.
/// Source: base_model.md section 8 (verdict terms), files.md `ambrig run --json`.
#include <algorithm>
#include <cmath>

#include "simulation/switching/bearing_run.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

void SwitchingEngine::Event(const std::string& kind, const std::string& target,
                            const std::string& fault_class, double fraction, double t) {
  result_.events.push_back(
      {t < 0 ? std::max(motion_.t, 0.0) : t, kind, target, fault_class, fraction});
}

void SwitchingEngine::Watch(long long n) {
  RunMetrics& m = result_.metrics;
  const bool late = motion_.t > 0.9 * scenario_.duration;
  for (BearingRun& b : bearings_) {
    for (int j = 0; j < b.plant->lanes.coils; ++j) {
      loss_sum_ += b.plant->lanes.resistance[j] * b.current.mean_square[j];
      m.peak_current = std::max(m.peak_current, b.current.largest[j]);
    }
    if (clamped_) continue;
    const double orbit_sq = b.true_x * b.true_x + b.true_y * b.true_y;
    b.max_orbit_sq = std::max(b.max_orbit_sq, orbit_sq);
    if (late) settled_orbit_sq_ = std::max(settled_orbit_sq_, orbit_sq);
  }
  if (!clamped_) contacts_->Period(motion_, n == 0, result_);
  WatchFaults(n);
}

void SwitchingEngine::WatchFaults(long long n) {
  if (!options_.supervisor) return;
  measurement_.period = n;
  measurement_.t = static_cast<double>(n) * T_;
  measurement_.samples = samples_;
  measurement_.readings = &loop_->readings();
  measurement_.reading_time = loop_->reading_time();
  measurement_.position_loop = controller_on_;
  measurement_.bearings.clear();
  // The bus at the period's end: the next one's first reading.
  const double bus = noise_->BusReading(plant_.bus.voltage,
                                        scenario_.noise ? rig_.amplifier.bus_noise : 0, n + 1, 0);
  for (const BearingRun& b : bearings_)
    measurement_.bearings.push_back({b.adc, &control_[b.index].duty, bus});
  const std::size_t before = result_.events.size();
  options_.supervisor->AfterPeriod(measurement_, control_, result_.events);
  if (options_.snapshots && result_.events.size() > before) Snapshot(result_.events.back().kind);
}

void SwitchingEngine::Snapshot(const std::string& label) {
  for (const BearingRun& b : bearings_) {
    if (b.plant->thrust) continue;
    FluxSnapshot s;
    s.t = std::max(motion_.t, 0.0);
    s.bearing = b.plant->name;
    s.label = label;
    for (int j = 0; j < b.plant->lanes.coils; ++j) {
      s.flux.push_back(b.plant->lanes.phi[j]);
      s.current.push_back(b.plant->lanes.i[j]);
    }
    s.x = b.true_x;
    s.y = b.true_y;
    result_.snapshots.push_back(std::move(s));
  }
}

void SwitchingEngine::Verdict() {
  RunMetrics& m = result_.metrics;
  if (!clamped_)
    for (const BearingRun& b : bearings_) m.max_orbit[b.plant->name] = std::sqrt(b.max_orbit_sq);
  m.settled_orbit = std::sqrt(settled_orbit_sq_);
  m.copper_loss = periods_ > 0 ? loss_sum_ / static_cast<double>(periods_) : 0;
  contacts_->Finish(motion_, result_);
  if (options_.snapshots) Snapshot("end of the run");
}

}  // namespace ambrig
