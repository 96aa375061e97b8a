#include "simulation/sampled/channel_values.h"

#include "rig/rig_channels.h"

namespace ambrig {

namespace {

void AddNamed(const std::vector<ChannelId>& channels, ChannelValues::Column column,
              std::vector<ChannelValues::Named>& to) {
  for (const ChannelId& id : channels) {
    column.kind = id.kind;
    column.index = id.index;
    to.push_back({id, column});
    if (id.kind == ChannelKind::kReading) ++column.owner;  // each axis has a reading of its own
  }
}

}  // namespace

std::vector<ChannelValues::Named> ChannelValues::Columns(
    const std::vector<ChannelKind>& of_bearings, bool stations) const {
  std::vector<Named> all;
  AddNamed(ChannelsOf(rig_, ChannelKind::kReading), {ChannelKind::kReading}, all);
  for (std::size_t b = 0; b < rig_.bearings.size(); ++b)
    for (const ChannelKind kind : of_bearings)
      AddNamed(ChannelsOf(rig_.bearings[b], kind), {kind, b}, all);
  for (std::size_t s = 0; s < rig_.stations.size() && stations; ++s)
    AddNamed(ChannelsOf(rig_.stations[s]), {ChannelKind::kTruePosition, s, 0, true}, all);
  for (const ChannelKind kind : {ChannelKind::kSpeed, ChannelKind::kAngle, ChannelKind::kBus})
    AddNamed(ChannelsOf(rig_, kind), {kind}, all);
  return all;
}

double ChannelValues::At(const Column& column, long long n, bool ahead) const {
  return Value(column, n, 0, false, ahead);
}

double ChannelValues::InBurst(const Column& column, long long n, int sample) const {
  return Value(column, n, sample, true, false);
}

const double* ChannelValues::Place(const Column& column) const {
  if (column.station) return nullptr;
  const bool second = column.index == 1;
  switch (column.kind) {
    case ChannelKind::kReading:
    case ChannelKind::kSpeed:
    case ChannelKind::kAngle:
    case ChannelKind::kBus:
      return nullptr;
    default:
      break;
  }
  const SampledBearing& b = *source_.bearings[column.owner];
  const BearingControl& control = source_.control[b.index];
  switch (column.kind) {
    case ChannelKind::kCoilCurrent:
      return &control.feedback.v[column.index];
    case ChannelKind::kSetPoint:
      return &control.set_point.v[column.index];
    case ChannelKind::kDuty:
      return &control.duty.v[column.index];
    case ChannelKind::kTruePosition:
      return second ? &b.true_y : &b.true_x;
    default:
      return second ? &b.fy : &b.fx;
  }
}

double ChannelValues::BearingValueInBurst(const Column& column, int sample) const {
  const SampledBearing& b = *source_.bearings[column.owner];
  if (column.kind == ChannelKind::kCoilCurrent) return b.adc[sample][column.index];
  // Rows of a burst are written when their period is over; the load cell holds the one before.
  if (column.kind == ChannelKind::kLoadCell) return column.index == 1 ? b.fy_before : b.fx_before;
  return *Place(column);
}

double ChannelValues::BusAt(int sample, bool burst) const {
  const bool moves = burst && !source_.plant.bus.stiff();
  return moves ? source_.bus_samples[static_cast<std::size_t>(sample)] : source_.plant.bus.voltage;
}

double ChannelValues::Value(const Column& column, long long n, int sample, bool burst,
                            bool ahead) const {
  const MotionState& motion = source_.motion;
  const RotorModel& rotor = source_.plant.rotor;
  const double inside = sample * T_ / samples_, t = static_cast<double>(n) * T_ + inside;
  switch (column.kind) {
    case ChannelKind::kReading: {
      const bool at_tick = sample == 0 && n % M_ == 0 && !ahead;
      return at_tick ? source_.loop.readings()[column.owner]
                     : source_.loop.Reading(column.owner, n);
    }
    case ChannelKind::kSpeed:
      return rotor.SpeedIsFree(t) ? motion.Omega : rotor.speed().Speed(t);
    case ChannelKind::kAngle:
      return rotor.SpeedIsFree(t) ? motion.theta + motion.Omega * inside : rotor.speed().Angle(t);
    case ChannelKind::kBus:
      return source_.noise.BusReading(BusAt(sample, burst),
                                      scenario_.noise ? rig_.amplifier.bus_noise : 0, n, sample);
    default:
      break;
  }
  if (!column.station) return burst ? BearingValueInBurst(column, sample) : *Place(column);
  const auto [x, y] = rotor.Position(motion, source_.plant.stations[column.owner].second);
  return column.index == 1 ? y : x;
}

}  // namespace ambrig
