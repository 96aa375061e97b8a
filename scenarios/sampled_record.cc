/// What leaves the sampled side: measurements for the supervisor, rows of the record (the switching
/// engine's, value by value).
#include <cmath>

#include "scenarios/record_layout.h"
#include "scenarios/sampled_rig.h"

namespace ambrig {

void SampledRig::AfterPeriod(long long n, RunResult& result) {
  if (!options.supervisor || n < 0) return;
  PeriodMeasurement m;
  m.period = n;
  m.t = static_cast<double>(n) * T;
  m.samples = samples;
  m.readings = &loop_->readings();
  m.reading_time = loop_->reading_time();
  m.position_loop = controller_on_;
  // The bus at the period's end: the next one's first reading.
  const double bus = noise_->BusReading(plant.bus.voltage, scenario.noise ? rig.amplifier.bus_noise : 0, n + 1, 0);
  for (const SampledBearing& b : bearings) m.bearings.push_back({b.adc, &control[b.index].duty, bus});
  options.supervisor->AfterPeriod(m, control, result.events);
}

void SampledRig::RecordStart() {
  const double rate = options.record_rate > 0 ? options.record_rate : scenario.record_rate;
  const double per_period = rate * T;
  if (per_period > 1 + 1e-9)
    row_samples_ = static_cast<int>(std::lround(samples / per_period));
  else
    row_periods_ = static_cast<int>(std::lround(1 / per_period));
  recorder_.emplace(rate, 0.0);
  channel_ = AddRecordChannels(*recorder_, rig, clamped,
                               static_cast<std::size_t>(std::ceil(scenario.duration * rate)) + 1);
}

void SampledRig::RecordBurst(long long n) {
  if (n < 0 || !recorder_ || row_samples_ == 0) return;
  for (int k = 0; k < samples; k += row_samples_) RecordRow(n, k);
}

void SampledRig::RecordRow(long long n, int sample) {
  const double inside = sample * h, t = static_cast<double>(n) * T + inside;
  std::size_t c = 0;
  const auto put = [&](double value) { recorder_->Put(channel_[c++], value); };
  const bool at_tick = sample == 0 && n % M == 0;
  for (std::size_t a = 0; a < loop_->axes(); ++a)
    put(at_tick ? loop_->readings()[a] : loop_->Reading(a, n));
  for (const SampledBearing& b : bearings) {
    const BearingControl& k = control[b.index];
    for (int j = 0; j < k.coils; ++j) put(row_samples_ > 0 ? b.adc[sample][j] : k.feedback[j]);
    for (int j = 0; j < k.coils; ++j) put(k.set_point[j]);
    for (int j = 0; j < k.coils; ++j) put(k.duty[j]);
    // Rows of a burst are written when their period is over; the load cell holds the one before it.
    put(!clamped ? b.true_x : row_samples_ > 0 ? b.fx_before : b.fx);
    if (b.axes > 1) put(!clamped ? b.true_y : row_samples_ > 0 ? b.fy_before : b.fy);
  }
  for (const auto& [name, plane] : plant.stations) {
    if (clamped) break;
    double x, y;
    plant.rotor.Position(motion, plane, &x, &y);
    put(x);
    put(y);
  }
  const bool free_spin = plant.rotor.SpeedIsFree(t);
  put(free_spin ? motion.Omega : scenario.speed.Speed(t));
  put(free_spin ? motion.theta + motion.Omega * inside : scenario.speed.Angle(t));
  put(noise_->BusReading(plant.bus.voltage, scenario.noise ? rig.amplifier.bus_noise : 0, n, sample));
}

}  // namespace ambrig
