#include "discovery/plan/abilities.h"

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "core/record/channels.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

namespace {

void AddCoils(const Scenario& s, Abilities& a) {
  double least = kInfinity;
  for (const Excitation& e : s.excitations) {
    if (!NamesCoil(e.target)) continue;
    a.coil_port = e.port;
    least = std::min(least, std::abs(e.amplitude));
    a.coil_most = std::max(a.coil_most, std::abs(e.amplitude));
    for (const double v : e.samples) a.coil_most = std::max(a.coil_most, std::abs(v));
  }
  if (least < kInfinity) a.coil_least = std::max(a.coil_least, least);
}

bool IsOffCentre(const std::map<std::string, std::array<double, 2>>& clamp) {
  return std::any_of(clamp.begin(), clamp.end(),
                     [](const auto& c) { return std::hypot(c.second[0], c.second[1]) > 0; });
}

}  // namespace

Abilities AbilitiesOf(const Case& c) {
  Abilities a;
  for (const CaseRecord& r : c.records) {
    if (r.kind != RecordKind::kTime) continue;  // says nothing of what a run may be
    const Scenario& s = r.scenario;
    a.top_speed = std::max(a.top_speed, s.speed.LargestSpeed(s.duration));
    for (const Channel& ch : r.data.channels) a.channels.insert(ch.name);
    const bool clamped = s.start == StartState::kClamped;
    a.clamp = a.clamp || clamped;
    a.levitate = a.levitate || s.start == StartState::kLevitated;
    a.land = a.land || s.start == StartState::kResting;
    a.load = a.load || !s.loads.empty();
    a.reference =
        a.reference || std::any_of(s.excitations.begin(), s.excitations.end(),
                                   [](const Excitation& e) { return e.port == "reference"; });
    if (clamped) AddCoils(s, a);
    if (clamped && (a.clamp_at.empty() || IsOffCentre(s.clamp))) a.clamp_at = s.clamp;
    if (r.data.rate > 2 * c.rig.controller.rate) {
      a.burst = a.burst || clamped;
      a.burst_rate = std::max(a.burst_rate, r.data.rate);
    } else {
      a.record_rate = std::max(a.record_rate, r.data.rate);
    }
  }
  if (a.record_rate == 0) a.record_rate = a.burst_rate;
  if (a.record_rate == 0) a.record_rate = c.rig.controller.rate;
  if (a.clamp && a.coil_most == 0) a.clamp = false;  // nothing was commanded: nothing can be
  return a;
}

Abilities StatedAbilities(const RigParameters& rig, double top_speed, bool clamp) {
  Abilities a;
  a.levitate = a.reference = true;
  a.land = std::any_of(rig.bearings.begin(), rig.bearings.end(),
                       [](const BearingParameters& b) { return b.auxiliary.has_value(); });
  a.top_speed = top_speed;
  a.record_rate = rig.controller.rate;
  if (!clamp) return a;
  a.clamp = a.burst = true;
  a.coil_port = "current";
  a.coil_least = 0.2 * rig.amplifier.i_max;
  a.coil_most = 0.75 * rig.amplifier.i_max;
  a.burst_rate = rig.amplifier.switching_frequency * rig.amplifier.adc_samples_per_period;
  for (const BearingParameters& b : rig.bearings)
    if (b.kind->two_axes && b.auxiliary)
      a.clamp_at[b.name] = {0.4 * b.auxiliary->clearance, -0.3 * b.auxiliary->clearance};
  return a;
}

}  // namespace ambrig
