/// Teacher-forced coils: measured set-points and measured readings drive the amplifiers and the
/// gaps, so that an error of the coil block shows where it arises. Discovery compares its currents.
#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "rig/bearing_kinds/bearing_kind.h"
#include "simulation/switching/bearing_run.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

namespace {
constexpr double kDrivenWarmUp = 0.01;  // [s] before t = 0

double At(const Record& record, const Channel* c, double t) {
  if (!c || c->samples.empty()) return 0;
  const double row =
      std::clamp((t - record.start) * record.rate, 0.0, static_cast<double>(c->samples.size() - 1));
  const auto k = static_cast<std::size_t>(row);
  const std::size_t next = std::min(k + 1, c->samples.size() - 1);
  return c->samples[k] + (row - static_cast<double>(k)) * (c->samples[next] - c->samples[k]);
}
}  // namespace

void SwitchingEngine::StartForced() {
  using Source = CurrentLoops::SetPoints;
  const Record& d = *options_.forced;
  const bool measured = std::ranges::any_of(
      d.channels, [](const Channel& c) { return IsOfKind(c.name, ChannelKind::kSetPoint); });
  // Set-points of a clamped run hold the coils' excitations already; where none were measured the
  // scenario's currents and duties drive.
  const Source source = scenario_.start != StartState::kClamped ? Source::kMeasured
                        : measured                              ? Source::kMeasuredWhole
                                                                : Source::kOfTheScenario;
  loop_.PrepareDriven(source, kDrivenWarmUp);
  if (source == Source::kOfTheScenario)
    for (const CommandPlan::Signal& s : loop_.commands().current)
      loop_.control[static_cast<std::size_t>(s.bearing)].set_point[s.index] +=
          CommandPlan::At(s, 0);
  FollowData(-loop_.warm);
  loop_.StartDriven();
}

void SwitchingEngine::ForcedPosition(const SampledBearing& b, double t, double* x,
                                     double* y) const {
  const Record& d = *options_.forced;
  double reading[4], z[2];
  std::size_t found = 0;
  for (const BearingParameters& p : loop_.nominal->bearings) {
    if (!p.kind->two_axes || found > 1) continue;
    z[found] = p.sensor.z;
    reading[2 * found] = At(d, Find(d, {ChannelKind::kReading, p.name, 0}), t);
    reading[2 * found + 1] = At(d, Find(d, {ChannelKind::kReading, p.name, 1}), t);
    ++found;
  }
  if (b.plant->thrust) {
    *x = At(d, Find(d, {ChannelKind::kReading, "", 2}), t);
    *y = 0;
  } else if (found == 2) {  // rigid shaft between the two sensor planes
    const double w = (b.plant->z - z[0]) / (z[1] - z[0]);
    *x = (1 - w) * reading[0] + w * reading[2];
    *y = (1 - w) * reading[1] + w * reading[3];
  } else {
    *x = At(d, Find(d, {ChannelKind::kReading, b.plant->name, 0}), t);
    *y = 0;
  }
}

void SwitchingEngine::FollowData(long long n) {
  const Record& d = *options_.forced;
  const double t = std::max(0.0, static_cast<double>(n) * T_);
  const auto row =
      static_cast<std::size_t>(std::max(0.0, std::floor((t - d.start) * d.rate + 1e-6)));
  for (BearingRun& b : bearings_) {
    BearingControl& c = loop_.control[b.side->index];
    for (int j = 0; j < c.coils; ++j) {
      const Channel* s = Find(d, {ChannelKind::kSetPoint, b.plant->name, j});
      if (s && !s->samples.empty())
        c.set_point[j] = s->samples[std::min(row, s->samples.size() - 1)];
    }
    c.commanded = c.set_point;
    PlanePoint p;
    ForcedPosition(*b.side, static_cast<double>(n) * T_, &p.x, &p.y);
    b.MoveTo(p);
  }
}

}  // namespace ambrig
