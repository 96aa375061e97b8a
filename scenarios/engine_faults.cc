/// Coil, amplifier and sensor faults of a scenario, put into the plant at their ADC sample.
/// Source: shared/design/physics.md section 6.
#include "scenarios/bearing_run.h"
#include "scenarios/switching_engine.h"

namespace ambrig {

void SwitchingEngine::Inject(const FaultSpec& fault) {
  Event("fault", fault.target, fault.kind, fault.Get("fraction", 0), fault.time);
  if (options_.snapshots) Snapshot("before the fault of " + fault.target);
  if (fault.kind == "bus-sag") {
    plant_.bus.source = fault.Get("voltage", 0.8 * rig_.amplifier.bus_voltage);
    if (plant_.bus.stiff()) plant_.bus.voltage = plant_.bus.source;
    bus_restore_at_ = fault.time + fault.Get("duration", kInfinity);
    return;
  }
  for (BearingRun& b : bearings_) {
    const BearingParameters& p = rig_.bearings[b.index];
    const std::string prefix = p.name + ".coil";
    if (fault.target.starts_with(prefix)) InjectCoil(fault, b, std::stoi(fault.target.substr(prefix.size())) - 1);
    std::size_t side = 0;
    for (const std::string& name : p.Axes()) {
      if (name == fault.target) {
        SensorFault& f = b.plant->sensor.fault[side];
        f.offset += fault.Get("offset", 0);
        f.lost = f.lost || fault.Get("lost", 0) != 0;
        f.stuck = f.stuck || fault.Get("stuck", 0) != 0;
      }
      ++side;
    }
  }
}

void SwitchingEngine::InjectCoil(const FaultSpec& fault, BearingRun& b, int coil) {
  StatorLanes& lanes = b.plant->lanes;
  const auto j = static_cast<std::size_t>(coil);
  b.faulty[j] = true;
  if (fault.kind == "open") {
    lanes.Break(coil, b.x, b.y);
  } else if (fault.kind == "partial-short" && !lanes.open[j]) {
    const double s = fault.Get("fraction", 0);
    lanes.ShortTurns(coil, s, fault.Get("short_resistance", kInfinity), b.x, b.y);
    b.plant->base_resistance[coil] *= 1 - s;
  } else if (fault.kind == "amplifier-off") {
    b.plant->bridge[j].off = true;
  } else if (fault.kind == "switch-stuck-on") {
    b.plant->bridge[j].stuck_on = true;
  } else if (fault.kind == "current-sensor") {
    CurrentSensor& s = b.plant->current_sensor[j];
    s.gain *= fault.Get("gain", 1);
    s.offset += fault.Get("offset", 0);
    if (fault.Get("stuck", 0) != 0) {
      s.stuck = true;
      s.stuck_at = lanes.i[coil];
    }
    b.plain_sensors = false;
  }
  if (fault.kind != "amplifier-off" && fault.kind != "switch-stuck-on") return;
  // The bridge changes in the middle of its period: rebuild this coil's voltage pattern.
  b.only_edge_moves = false;
  SetPattern(b, coil, control_[b.index].amplifier[j].Pattern(control_[b.index].duty[coil], b.plant->bridge[j]));
}

}  // namespace ambrig
