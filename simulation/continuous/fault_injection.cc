#include "simulation/continuous/fault_injection.h"

#include <cmath>

#include "simulation/sampled/fault_effects.h"

namespace ambrig {

namespace {
constexpr double kSame = 1e-10;  // [s] two instants that are one
}  // namespace

FaultInjection::FaultInjection(SampledRig& rig, ContinuousRig& plant, RunResult& result)
    : rig_(rig), plant_(plant), result_(result) {}

double FaultInjection::Snapped(const FaultSpec& f) const {
  return std::floor(f.time / rig_.h + 0.5) * rig_.h;
}

void FaultInjection::Instants(long long n, std::vector<double>& out) const {
  const double t0 = static_cast<double>(n) * rig_.T;
  const auto add = [&](double t) {
    if (std::isfinite(t) && t > t0 - kSame && t < t0 + rig_.T - kSame)
      out.push_back(std::max(t - t0, 0.0));
  };
  for (std::size_t k = next_; k < rig_.scenario.faults.size(); ++k) {
    const FaultSpec& f = rig_.scenario.faults[k];
    add(Snapped(f));
    if (f.kind == "bus-sag") add(f.time + f.Get("duration", kInfinity));
  }
  add(bus_back_at_);
}

bool FaultInjection::Due(long long n, double tau) {
  if (n < 0) return false;
  const double t = static_cast<double>(n) * rig_.T + tau;
  bool changed = false;
  while (next_ < rig_.scenario.faults.size() && Snapped(rig_.scenario.faults[next_]) <= t + kSame)
    changed = Inject(rig_.scenario.faults[next_++]) || changed;
  if (bus_back_at_ <= t + kSame) {
    rig_.plant.bus.source = rig_.plant.bus.voltage = rig_.rig.amplifier.bus_voltage;
    bus_back_at_ = kInfinity;
    changed = true;
  }
  return changed;
}

bool FaultInjection::Inject(const FaultSpec& f) {
  result_.events.push_back({f.time, "fault", f.target, f.kind, f.Get("fraction", 0)});
  if (f.kind == "bus-sag") {
    rig_.plant.bus.source = rig_.plant.bus.voltage =
        f.Get("voltage", 0.8 * rig_.rig.amplifier.bus_voltage);
    bus_back_at_ = f.time + f.Get("duration", kInfinity);
    return true;
  }
  const FaultPlace place = PlaceOf(f, rig_.rig);
  const double current = place.coil < 0 ? 0 : plant_.Current(place.bearing, place.coil);
  const bool bridge = ApplyToPlant(f, place, current, *rig_.bearings[place.bearing].plant);
  if (f.kind == "open" || f.kind == "partial-short")
    plant_.InjectCoil(place.bearing, place.coil, f);
  return bridge;
}

}  // namespace ambrig
