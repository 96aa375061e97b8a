#include "discovery/model/record_traits.h"

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"
#include "core/record/missing_samples.h"
#include "effects/catalogue.h"
#include "rig/rig_channels.h"

namespace ambrig {

namespace {

constexpr std::uint32_t kPositionStream = 0x4d000000;  // of the noise of imposed positions
constexpr double kTouch = 0.85;  // of the clearance: the measured rotor was at its stop

bool CommandsCoils(const Scenario& scenario) {
  return scenario.start == StartState::kClamped &&
         std::ranges::any_of(scenario.excitations, [](const Excitation& e) {
           return e.port == "current" || e.port == "duty";
         });
}

}  // namespace

bool Touches(const RigParameters& rig, const CaseRecord& record) {
  for (const BearingParameters& b : rig.bearings) {
    if (!b.auxiliary) continue;
    double most = 0;
    const std::vector<std::string> axes = b.Axes();
    const Channel *x = record.data.Find(axes[0]),
                  *y = axes.size() > 1 ? record.data.Find(axes[1]) : nullptr;
    if (!x) continue;
    for (std::size_t k = 0; k < x->samples.size(); ++k) {
      const double at = std::hypot(x->samples[k], y ? y->samples[k] : 0);
      if (std::isfinite(at)) most = std::max(most, at);
    }
    // what is far outside is a wrong unit, no contact
    if (most > kTouch * b.auxiliary->clearance && most < 5 * b.auxiliary->clearance) return true;
  }
  return false;
}

bool IsPredicted(const CaseRecord& record, const std::string& channel) {
  const auto id = ParseChannel(channel);
  if (!id || id->row().reader == ChannelReader::kSimulator) return false;
  const bool free_speed = record.scenario.speed_free_from < record.scenario.duration;
  const bool prescribed =
      id->kind == ChannelKind::kAngle || (id->kind == ChannelKind::kSpeed && !free_speed);
  const bool command =
      record.scenario.start == StartState::kClamped && id->kind == ChannelKind::kSetPoint;
  // what drives is not predicted
  if (record.imposed == Imposed::kCurrents) return id->kind == ChannelKind::kReading;
  const bool drives = record.imposed == Imposed::kMotion &&
                      (id->kind == ChannelKind::kReading || id->kind == ChannelKind::kSetPoint);
  return !prescribed && !command && !drives;
}

bool HasSettled(const CaseRecord& record, double t) {
  if (record.imposed == Imposed::kCurrents) return t >= record.data.start + 1 / record.observer;
  return record.imposed == Imposed::kNothing || record.scenario.start == StartState::kClamped ||
         t >= record.data.start + kLoopsSettle;
}

Record DrivingRecord(const RigParameters& rig, const CaseRecord& record) {
  const bool commanded = CommandsCoils(record.scenario);
  const bool currents = record.imposed == Imposed::kCurrents;
  const auto drives = [&](const std::string& name) {
    if (IsOfKind(name, ChannelKind::kReading)) return true;
    return currents ? IsOfKind(name, ChannelKind::kCoilCurrent)
                    : !commanded && IsOfKind(name, ChannelKind::kSetPoint);
  };
  Record out = BridgeMissing(record.data, 0, drives).record;
  std::erase_if(out.channels, [&](const Channel& c) { return !drives(c.name); });
  for (const BearingParameters& b : rig.bearings) {
    const auto at = record.scenario.clamp.find(b.name);
    const std::vector<std::string> axes = b.Axes();
    for (std::size_t side = 0; at != record.scenario.clamp.end() && side < axes.size(); ++side)
      if (!out.Find(axes[side]))
        out.channels.push_back(
            {axes[side], "m", std::vector<double>(record.data.rows(), at->second[side])});
  }
  return out;
}

Record WithReadingNoise(Record driving, const RigParameters& rig, std::uint64_t seed) {
  std::uint32_t stream = kPositionStream;
  for (const BearingParameters& b : rig.bearings)
    for (const std::string& axis : b.Axes()) {
      ++stream;
      for (Channel& c : driving.channels)
        if (c.name == axis)
          for (std::size_t k = 0; k < c.samples.size(); ++k)
            c.samples[k] += b.sensor.noise * Normal(seed, stream, k);
    }
  const double noise =
      rig.amplifier.current_noise / std::sqrt(rig.amplifier.adc_samples_per_period);
  for (Channel& c : driving.channels)
    if (IsOfKind(c.name, ChannelKind::kCoilCurrent)) {
      ++stream;
      for (std::size_t k = 0; k < c.samples.size(); ++k)
        c.samples[k] += noise * Normal(seed, stream, k);
    }
  return driving;
}

std::vector<const Channel*> ChannelsIn(const Record& record, const BearingParameters& b,
                                       ChannelKind kind) {
  std::vector<const Channel*> out;
  for (const ChannelId& id : ChannelsOf(b, kind)) {
    out.push_back(Find(record, id));
    if (!out.back()) return {};
  }
  return out;
}

bool Feels(const CaseRecord& record, const EffectInstance& e) {
  const EffectDescription* d = FindEffect(e.name);
  if (record.scenario.start != StartState::kClamped || !d || e.IsFormula()) return true;
  const EffectNeeds& n = d->needs;
  if (n.contact || n.free_speed) return false;
  return !(n.levitation && !n.rotation && d->whole_periods.empty() &&
           d->target != TargetKind::kPlaneOrRig);
}

}  // namespace ambrig
