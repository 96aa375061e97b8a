#include "scenarios/faults/faulted_plant.h"

#include "core/base/errors.h"

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

BridgeImperfection& FaultedPlant::Bridge() {
  Require(place_.coil >= 0, "a fault of a coil");
  bridge_changed_ = true;
  return bearing().bridge[static_cast<std::size_t>(place_.coil)];
}

CurrentSensor& FaultedPlant::CoilSensor() {
  Require(place_.coil >= 0, "a fault of a coil");
  sensor_changed_ = true;
  return bearing().current_sensor[static_cast<std::size_t>(place_.coil)];
}

SensorFault& FaultedPlant::Reading() {
  Require(place_.side >= 0, "a fault of an axis");
  return bearing().sensor.fault[static_cast<std::size_t>(place_.side)];
}

void FaultedPlant::SetBus(double volts) {
  bus_changed_ = true;
  plant_.bus.source = volts;
  if (plant_.bus.stiff()) plant_.bus.voltage = volts;
}

}  // namespace ambrig
