#include "discovery/plan/safety.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/record/channels.h"
#include "rig/clearance.h"
#include "rig/rig_channels.h"

namespace ambrig {

namespace {

constexpr double kAtLimit = 1e-3;  // of the duty

/// Largest distance from the centre that the readings of a bearing reach, after `from`. [m]
double OrbitOf(const Record& record, const BearingParameters& b, double from) {
  const std::vector<std::string> axes = b.Axes();
  const Channel *x = record.Find(axes[0]), *y = axes.size() > 1 ? record.Find(axes[1]) : nullptr;
  double most = 0;
  for (std::size_t k = 0; x && k < x->samples.size(); ++k)
    if (record.TimeAt(k) >= from)
      most = std::max(most, std::hypot(x->samples[k], y ? y->samples[k] : 0));
  return most;
}

/// Largest share of samples of any coil at a limit of the duty.
double Saturated(const Record& record, const RigParameters& rig, const BearingParameters& b) {
  double most = 0;
  const double lo = rig.amplifier.duty_min, hi = rig.amplifier.duty_max;
  for (const ChannelId& id : ChannelsOf(b, ChannelKind::kDuty)) {
    const Channel* d = record.Find(id.name());
    if (!d || d->samples.empty()) continue;
    double at = 0;
    for (const double v : d->samples) at += v <= lo + kAtLimit || v >= hi - kAtLimit ? 1 : 0;
    most = std::max(most, at / static_cast<double>(d->samples.size()));
  }
  return most;
}

}  // namespace

SafetyResult CheckSafety(const TrialRecord& trial, const Rival& rival, const SafetyLimits& limits) {
  SafetyResult out;
  const RigParameters& rig = trial.model->data().rig;
  const Scenario& scenario = trial.model->data().records[0].scenario;
  Record record;
  try {
    record = trial.model->Simulated(rival.hypothesis, 0, true, scenario.seed);
  } catch (const std::runtime_error& e) {
    if (dynamic_cast<const Interrupted*>(&e) || dynamic_cast<const InputError*>(&e)) throw;
    out.reason = "the rotor is lost with " + rival.Name();
    return out;
  }
  const bool levitated = scenario.start == StartState::kLevitated;
  for (const BearingParameters& b : rig.bearings) {
    // a rotor that lifts off starts at its stop, and a held one goes nowhere
    const double orbit = scenario.start == StartState::kClamped
                             ? 0
                             : OrbitOf(record, b, levitated ? 0 : 0.5 * scenario.duration);
    if (orbit > out.largest_orbit) out.largest_orbit = orbit, out.orbit_at = b.name;
    const double allowed = limits.orbit * ClearanceOf(b);
    out.orbit_share = std::max(out.orbit_share, orbit / allowed);
    if (orbit > allowed)
      out.reason = fmt::format("orbit of {:.3g} um at {}, allowed {:.3g} um", 1e6 * orbit, b.name,
                               1e6 * allowed);
    for (const ChannelId& id : ChannelsOf(b, ChannelKind::kCoilCurrent))
      if (const Channel* i = record.Find(id.name()))
        for (const double v : i->samples)
          out.largest_current = std::max(out.largest_current, std::abs(v));
    const double share = Saturated(record, rig, b);
    if (levitated && share > limits.saturation)
      out.reason =
          fmt::format("the voltage limit holds in {:.0f} % of the time at {}", 100 * share, b.name);
  }
  if (out.largest_current > limits.current * rig.amplifier.i_max)
    out.reason = fmt::format("current of {:.3g} A, allowed {:.3g} A", out.largest_current,
                             limits.current * rig.amplifier.i_max);
  out.safe = out.reason.empty();
  return out;
}

}  // namespace ambrig
