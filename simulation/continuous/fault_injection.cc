#include "simulation/continuous/fault_injection.h"

#include <cmath>

#include "scenarios/faults/faulted_plant.h"
#include "simulation/sampled/instants.h"

namespace ambrig {

namespace {

/// The coils as networks of windings (actuators/magnetics/coil_network.h).
class FaultedNetwork : public FaultedPlant {
 public:
  FaultedNetwork(SampledDataLoop& rig, ContinuousRig& plant, const FaultPlace& place)
      : FaultedPlant(rig.plant, place, rig.rig.amplifier.bus_voltage), rig_(plant) {}

  double Current() const override { return rig_.Current(place_.bearing, place_.coil); }
  void BreakCoil() override { rig_.BreakCoil(place_.bearing, place_.coil); }
  void ShortTurns(double fraction, double resistance) override {
    rig_.ShortTurns(place_.bearing, place_.coil, fraction, resistance);
  }

 private:
  ContinuousRig& rig_;
};

/// Whether voltages must be set again.
bool VoltagesChanged(const FaultedPlant& plant) {
  return plant.bridge_changed() || plant.bus_changed();
}

}  // namespace

FaultInjection::FaultInjection(SampledDataLoop& rig, ContinuousRig& plant, RunResult& result)
    : rig_(rig), plant_(plant), result_(result) {}

double FaultInjection::Snapped(const FaultSpec& f) const {
  return std::floor(f.time / rig_.h + 0.5) * rig_.h;
}

void FaultInjection::Instants(long long n, std::vector<double>& out) const {
  const double t0 = static_cast<double>(n) * rig_.T;
  const auto add = [&](double t) {
    if (std::isfinite(t) && t > t0 - kSameTime && t < t0 + rig_.T - kSameTime)
      out.push_back(std::max(t - t0, 0.0));
  };
  for (std::size_t k = next_; k < rig_.scenario.faults.size(); ++k) {
    const FaultSpec& f = rig_.scenario.faults[k];
    add(Snapped(f));
    const Fault& fault = FaultByKind(f.kind);
    if (fault.duration) add(f.time + fault.duration(f));
  }
  add(ends_.next());
}

bool FaultInjection::Due(long long n, double tau) {
  if (n < 0) return false;
  const double t = static_cast<double>(n) * rig_.T + tau;
  bool changed = false;
  while (next_ < rig_.scenario.faults.size() &&
         Snapped(rig_.scenario.faults[next_]) <= t + kSameTime)
    changed = Inject(rig_.scenario.faults[next_++]) || changed;
  while (ends_.next() <= t + kSameTime) {
    const FaultSpec& spec = ends_.Take();
    FaultedNetwork plant(rig_, plant_, PlaceOf(spec, rig_.rig));
    FaultByKind(spec.kind).end(plant);
    changed = changed || VoltagesChanged(plant);
  }
  return changed;
}

bool FaultInjection::Inject(const FaultSpec& f) {
  result_.events.push_back({f.time, "fault", f.target, f.kind, f.Get("fraction", 0)});
  const Fault& fault = FaultByKind(f.kind);
  FaultedNetwork plant(rig_, plant_, PlaceOf(f, rig_.rig));
  fault.apply(f, plant);
  if (plant.sensor_changed()) rig_.bearings[PlaceOf(f, rig_.rig).bearing].plain_sensors = false;
  ends_.Add(fault, f);
  return VoltagesChanged(plant);
}

}  // namespace ambrig
