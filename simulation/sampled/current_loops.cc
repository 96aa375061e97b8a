#include "simulation/sampled/current_loops.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/base/index.h"

namespace ambrig {

namespace {
/// Whether some lane is not 0, without a branch for each.
bool AnyProbe(const BearingControl& c) {
  std::uint64_t bits = 0;
  for (const double probe : c.probe.v) bits |= std::bit_cast<std::uint64_t>(probe);
  return bits != 0;
}
}  // namespace

long long CurrentLoops::CommandsOf(long long n) const {
  return n >= 0 ? n : source_ == SetPoints::kOfTheController ? -1 : 0;
}

void CurrentLoops::Targets(long long n, std::vector<BearingControl>& control) {
  const long long at = CommandsOf(n);
  const bool scenario = source_ == SetPoints::kOfTheScenario;
  target_.resize(control.size());
  for (std::size_t k = 0; k < control.size(); ++k)
    target_[k] = scenario ? Lane{} : control[k].commanded;
  if (at >= 0 && source_ != SetPoints::kMeasuredWhole)
    for (const CommandPlan::Signal& s : commands_.current)
      target_[AsSize(s.bearing)][s.index] += CommandPlan::At(s, at);
  for (const CommandPlan::StartCurrent& s : commands_.start)
    if (n < 0) target_[AsSize(s.bearing)][s.index] = s.set_point;
  for (std::size_t k = 0; scenario && k < control.size(); ++k) control[k].set_point = target_[k];
  for (std::size_t k = 0; k < control.size(); ++k)
    for (int j = 0; j < control[k].coils && AnyProbe(control[k]); ++j)
      if (control[k].probe[j] > 0) target_[k][j] = control[k].probe[j];
}

void CurrentLoops::Period(long long n, std::vector<BearingControl>& control) {
  Targets(n, control);
  for (std::size_t k = 0; k < control.size(); ++k) {
    BearingControl& c = control[k];
    const Lane& target = target_[k];
    if (first_period_)
      std::fill_n(c.duty.v, c.coils, duty_min_);
    else
      c.regulator.Duties(target, c.feedback, c.coils, &c.duty);
    for (int j = 0; j < c.coils && c.AnyDisabled(); ++j)
      if (c.disabled[AsSize(j)]) c.duty[j] = 0;
  }
  first_period_ = false;
  const long long at = CommandsOf(n);
  if (at < 0) return;
  for (const CommandPlan::Signal& s : commands_.duty) {
    if (n < 0 && commands_.StartsAt(s)) continue;
    control[AsSize(s.bearing)].duty[s.index] =
        std::clamp(CommandPlan::At(s, at), std::min(0.0, duty_min_), 1.0);
  }
}

}  // namespace ambrig
