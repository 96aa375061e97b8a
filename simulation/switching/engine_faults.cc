/// Coil, amplifier and sensor faults of a scenario, put into the plant at their ADC sample.
/// Source: docs/theory/base_model.md section 6.
#include "simulation/sampled/fault_effects.h"
#include "simulation/switching/bearing_run.h"
#include "simulation/switching/switching_engine.h"

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
  const FaultPlace place = PlaceOf(fault, rig_);
  BearingRun& b = bearings_[place.bearing];
  const bool bridge =
      ApplyToPlant(fault, place, place.coil < 0 ? 0 : b.plant->lanes.i[place.coil], *b.plant);
  if (place.coil < 0) return;
  InjectCoil(fault, b, place.coil);
  if (!bridge) return;
  // The bridge changes in the middle of its period: rebuild this coil's voltage pattern.
  const auto j = static_cast<std::size_t>(place.coil);
  b.only_edge_moves = false;
  SetPattern(b, place.coil,
             control_[b.index].amplifier[j].Pattern(control_[b.index].duty[place.coil],
                                                    b.plant->bridge[j]));
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
  }
  if (fault.kind == "current-sensor") b.plain_sensors = false;
}

}  // namespace ambrig
