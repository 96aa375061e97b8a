#include "scenarios/fault_injection.h"

#include <cmath>

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
  bool bridge = false;
  for (SampledBearing& b : rig_.bearings) {
    const BearingParameters& p = rig_.rig.bearings[b.index];
    const std::string prefix = p.name + ".coil";
    if (f.target.starts_with(prefix)) {
      const int coil = std::stoi(f.target.substr(prefix.size())) - 1;
      const auto j = static_cast<std::size_t>(coil);
      if (f.kind == "amplifier-off") b.plant->bridge[j].off = bridge = true;
      if (f.kind == "switch-stuck-on") b.plant->bridge[j].stuck_on = bridge = true;
      if (f.kind == "open" || f.kind == "partial-short") plant_.InjectCoil(b.index, coil, f);
      if (f.kind == "current-sensor") {
        CurrentSensor& s = b.plant->current_sensor[j];
        s.gain *= f.Get("gain", 1);
        s.offset += f.Get("offset", 0);
        if (f.Get("stuck", 0) != 0) {
          s.stuck = true;
          s.stuck_at = plant_.Current(b.index, coil);
        }
      }
    }
    std::size_t side = 0;
    for (const std::string& axis : p.Axes()) {
      if (axis == f.target) {
        SensorFault& fault = b.plant->sensor.fault[side];
        fault.offset += f.Get("offset", 0);
        fault.lost = fault.lost || f.Get("lost", 0) != 0;
        fault.stuck = fault.stuck || f.Get("stuck", 0) != 0;
      }
      ++side;
    }
  }
  return bridge;
}

}  // namespace ambrig
