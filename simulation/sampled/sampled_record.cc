/// What leaves the sampled side: measurements for the supervisor, rows of the record.
#include "simulation/sampled/sampled_rig.h"

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
  const double bus =
      noise_->BusReading(plant.bus.voltage, scenario.noise ? rig.amplifier.bus_noise : 0, n + 1, 0);
  for (const SampledBearing& b : bearings)
    m.bearings.push_back({b.adc, &control[b.index].duty, bus});
  options.supervisor->AfterPeriod(m, control, result.events);
}

void SampledRig::RecordStart() {
  RowSource source{plant, motion, *loop_, *noise_, control, {}};
  for (const SampledBearing& b : bearings) source.bearings.push_back(&b);
  record_.emplace(rig, scenario, options.record_rate, clamped, source);
}

}  // namespace ambrig
