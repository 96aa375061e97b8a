#include "simulation/record/run_record.h"

#include <fmt/format.h>

#include <cmath>

namespace ambrig {

RunRecord::RunRecord(const RigParameters& rig, const Scenario& scenario, double rate, bool clamped,
                     const RowSource& source)
    : rig_(rig),
      scenario_(scenario),
      source_(source),
      clamped_(clamped),
      T_(1 / rig.amplifier.switching_frequency),
      samples_(rig.samples_per_period()),
      M_(rig.periods_per_control()) {
  record_.rate = rate > 0 ? rate : scenario.record_rate;
  const double per_period = record_.rate * T_;
  if (per_period > 1 + 1e-9)
    row_samples_ = static_cast<int>(std::lround(samples_ / per_period));
  else
    row_periods_ = static_cast<int>(std::lround(1 / per_period));
  AddChannels(static_cast<std::size_t>(std::ceil(scenario.duration * record_.rate)) + 1);
}

void RunRecord::AddChannels(std::size_t rows) {
  const auto add = [&](const std::string& name, const char* unit) {
    record_.channels.push_back({name, unit, {}});
    record_.channels.back().samples.resize(rows);
  };
  for (const BearingParameters& b : rig_.bearings)
    for (const std::string& axis : b.Axes()) add(axis, "m");
  for (const BearingParameters& b : rig_.bearings) {
    for (int j = 1; j <= b.coils(); ++j) add(fmt::format("{}.i{}", b.name, j), "A");
    for (int j = 1; j <= b.coils(); ++j) add(fmt::format("{}.s{}", b.name, j), "A");
    for (int j = 1; j <= b.coils(); ++j) add(fmt::format("{}.d{}", b.name, j), "-");
    if (clamped_) {
      add(b.kind == BearingKind::kThrust ? b.name + ".fz" : b.name + ".fx", "N");
      if (b.kind == BearingKind::kRadial) add(b.name + ".fy", "N");
    } else {
      add(b.kind == BearingKind::kThrust ? "r.z" : b.name + ".r.x", "m");
      if (b.kind == BearingKind::kRadial) add(b.name + ".r.y", "m");
    }
  }
  for (const ShaftPlane& s : rig_.stations) {  // true positions of a beam rotor's named planes
    if (clamped_) break;
    add(s.name + ".r.x", "m");
    add(s.name + ".r.y", "m");
  }
  add("omega", "rad/s");
  add("theta", "rad");
  add("bus", "V");
}

void RunRecord::Row(long long n, int sample) {
  const MotionState& motion = source_.motion;
  const RotorModel& rotor = source_.plant.rotor;
  const double inside = sample * T_ / samples_, t = static_cast<double>(n) * T_ + inside;
  if (row_ == record_.rows())
    for (Channel& c : record_.channels) c.samples.resize(row_ + 1);
  auto channel = record_.channels.begin();
  const auto put = [&](double value) { (channel++)->samples[row_] = value; };
  const bool at_tick = sample == 0 && n % M_ == 0;
  for (std::size_t a = 0; a < source_.loop.axes(); ++a)
    put(at_tick ? source_.loop.readings()[a] : source_.loop.Reading(a, n));
  for (const SampledBearing* b : source_.bearings) {
    const BearingControl& k = source_.control[b->index];
    for (int j = 0; j < k.coils; ++j) put(row_samples_ > 0 ? b->adc[sample][j] : k.feedback[j]);
    for (int j = 0; j < k.coils; ++j) put(k.set_point[j]);
    for (int j = 0; j < k.coils; ++j) put(k.duty[j]);
    // Rows of a burst are written when their period is over; the load cell holds the one before it.
    put(!clamped_ ? b->true_x : row_samples_ > 0 ? b->fx_before : b->fx);
    if (b->axes > 1) put(!clamped_ ? b->true_y : row_samples_ > 0 ? b->fy_before : b->fy);
  }
  for (const auto& [name, plane] : source_.plant.stations) {
    if (clamped_) break;
    const auto [x, y] = rotor.Position(motion, plane);
    put(x);
    put(y);
  }
  const bool free_spin = rotor.SpeedIsFree(t);
  put(free_spin ? motion.Omega : scenario_.speed.Speed(t));
  put(free_spin ? motion.theta + motion.Omega * inside : scenario_.speed.Angle(t));
  put(source_.noise.BusReading(source_.plant.bus.voltage,
                               scenario_.noise ? rig_.amplifier.bus_noise : 0, n, sample));
  ++row_;
}

Record RunRecord::Take() {
  for (Channel& c : record_.channels) c.samples.resize(row_);
  return std::move(record_);
}

}  // namespace ambrig
