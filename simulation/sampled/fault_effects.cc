#include "simulation/sampled/fault_effects.h"

namespace ambrig {

FaultPlace PlaceOf(const FaultSpec& fault, const RigParameters& rig) {
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    const std::string prefix = rig.bearings[k].name + ".coil";
    if (fault.target.starts_with(prefix))
      return {k, std::stoi(fault.target.substr(prefix.size())) - 1, -1};
    const std::vector<std::string> axes = rig.bearings[k].Axes();
    for (std::size_t side = 0; side < axes.size(); ++side)
      if (axes[side] == fault.target) return {k, -1, static_cast<int>(side)};
  }
  return {};
}

bool ApplyToPlant(const FaultSpec& fault, const FaultPlace& place, double current,
                  BearingPlant& plant) {
  if (place.side >= 0) {
    SensorFault& f = plant.sensor.fault[static_cast<std::size_t>(place.side)];
    f.offset += fault.Get("offset", 0);
    f.lost = f.lost || fault.Get("lost", 0) != 0;
    f.stuck = f.stuck || fault.Get("stuck", 0) != 0;
    return false;
  }
  const auto j = static_cast<std::size_t>(place.coil);
  BridgeImperfection& bridge = plant.bridge[j];
  if (fault.kind == "amplifier-off") bridge.off = true;
  if (fault.kind == "switch-stuck-on") bridge.stuck_on = true;
  if (fault.kind == "current-sensor") {
    CurrentSensor& s = plant.current_sensor[j];
    s.gain *= fault.Get("gain", 1);
    s.offset += fault.Get("offset", 0);
    if (fault.Get("stuck", 0) != 0) {
      s.stuck = true;
      s.stuck_at = current;
    }
  }
  return fault.kind == "amplifier-off" || fault.kind == "switch-stuck-on";
}

}  // namespace ambrig
