#include "simulation/record/run_record.h"

#include <cmath>

#include "rig/rig_channels.h"

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

void RunRecord::Add(const std::vector<ChannelId>& channels, Column column, std::size_t rows) {
  for (const ChannelId& id : channels) {
    record_.channels.push_back({id.name(), std::string(id.row().unit), std::vector<double>(rows)});
    column.kind = id.kind;
    column.index = id.index;
    columns_.push_back(column);
    if (id.kind == ChannelKind::kReading) ++column.owner;  // each axis has a reading of its own
  }
}

void RunRecord::AddChannels(std::size_t rows) {
  // A shaft that is held stands in load cells; its true position says nothing.
  const ChannelKind held = clamped_ ? ChannelKind::kLoadCell : ChannelKind::kTruePosition;
  Add(ChannelsOf(rig_, ChannelKind::kReading), {ChannelKind::kReading}, rows);
  for (std::size_t b = 0; b < rig_.bearings.size(); ++b)
    for (const ChannelKind kind :
         {ChannelKind::kCoilCurrent, ChannelKind::kSetPoint, ChannelKind::kDuty, held})
      Add(ChannelsOf(rig_.bearings[b], kind), {kind, b}, rows);
  for (std::size_t s = 0; s < rig_.stations.size() && !clamped_; ++s)
    Add(ChannelsOf(rig_.stations[s]), {ChannelKind::kTruePosition, s, 0, true}, rows);
  for (const ChannelKind kind : {ChannelKind::kSpeed, ChannelKind::kAngle, ChannelKind::kBus})
    Add(ChannelsOf(rig_, kind), {kind}, rows);
}

double RunRecord::BearingValue(const Column& column, int sample) const {
  const SampledBearing& b = *source_.bearings[column.owner];
  const BearingControl& control = source_.control[b.index];
  const bool burst = row_samples_ > 0, second = column.index == 1;
  switch (column.kind) {
    case ChannelKind::kCoilCurrent:
      return burst ? b.adc[sample][column.index] : control.feedback[column.index];
    case ChannelKind::kSetPoint:
      return control.set_point[column.index];
    case ChannelKind::kDuty:
      return control.duty[column.index];
    case ChannelKind::kTruePosition:
      return second ? b.true_y : b.true_x;
    default:
      // Rows of a burst are written when their period is over; the load cell holds the one before.
      if (burst) return second ? b.fy_before : b.fx_before;
      return second ? b.fy : b.fx;
  }
}

double RunRecord::Value(const Column& column, long long n, int sample) const {
  const MotionState& motion = source_.motion;
  const RotorModel& rotor = source_.plant.rotor;
  const double inside = sample * T_ / samples_, t = static_cast<double>(n) * T_ + inside;
  switch (column.kind) {
    case ChannelKind::kReading: {
      const bool at_tick = sample == 0 && n % M_ == 0;
      return at_tick ? source_.loop.readings()[column.owner]
                     : source_.loop.Reading(column.owner, n);
    }
    case ChannelKind::kSpeed:
      return rotor.SpeedIsFree(t) ? motion.Omega : scenario_.speed.Speed(t);
    case ChannelKind::kAngle:
      return rotor.SpeedIsFree(t) ? motion.theta + motion.Omega * inside : scenario_.speed.Angle(t);
    case ChannelKind::kBus:
      return source_.noise.BusReading(source_.plant.bus.voltage,
                                      scenario_.noise ? rig_.amplifier.bus_noise : 0, n, sample);
    default:
      break;
  }
  if (!column.station) return BearingValue(column, sample);
  const auto [x, y] = rotor.Position(motion, source_.plant.stations[column.owner].second);
  return column.index == 1 ? y : x;
}

void RunRecord::Row(long long n, int sample) {
  if (row_ == record_.rows())
    for (Channel& c : record_.channels) c.samples.resize(row_ + 1);
  for (std::size_t k = 0; k < columns_.size(); ++k)
    record_.channels[k].samples[row_] = Value(columns_[k], n, sample);
  ++row_;
}

Record RunRecord::Take() {
  for (Channel& c : record_.channels) c.samples.resize(row_);
  return std::move(record_);
}

}  // namespace ambrig
