/// Faults of a scenario, put into the switching engine's plant at their ADC sample.
/// Source: docs/theory/base_model.md section 6.
#include "scenarios/faults/faulted_plant.h"
#include "simulation/switching/bearing_run.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

/// The coils in lanes (actuators/magnetics/stator_lanes.h).
class SwitchingEngine::FaultedLanes : public FaultedPlant {
 public:
  FaultedLanes(SwitchingEngine& engine, const FaultPlace& place)
      : FaultedPlant(engine.plant_, place, engine.loop_.rig.amplifier.bus_voltage),
        run_(engine.bearings_[place.bearing]) {}

  double Current() const override { return run_.plant->lanes.i[place_.coil]; }
  void BreakCoil() override { run_.plant->lanes.Break(place_.coil, run_.x, run_.y); }
  void ShortTurns(double fraction, double resistance) override {
    StatorLanes& lanes = run_.plant->lanes;
    if (lanes.open[static_cast<std::size_t>(place_.coil)]) return;
    lanes.ShortTurns(place_.coil, fraction, resistance, run_.x, run_.y);
    run_.plant->base_resistance[place_.coil] *= 1 - fraction;
  }

 private:
  BearingRun& run_;
};

void SwitchingEngine::Inject(const FaultSpec& spec) {
  result_.events.push_back({spec.time, "fault", spec.target, spec.kind, spec.Get("fraction", 0)});
  if (options_.snapshots) Snapshot("before the fault of " + spec.target);
  const Fault& fault = FaultByKind(spec.kind);
  const FaultPlace place = PlaceOf(spec, loop_.rig);
  FaultedLanes plant(*this, place);
  fault.apply(spec, plant);
  fault_ends_.Add(fault, spec);
  AfterFault(place, plant);
}

void SwitchingEngine::EndFaultsBefore(double t) {
  while (fault_ends_.next() < t) {
    const FaultSpec& spec = fault_ends_.Take();
    const FaultPlace place = PlaceOf(spec, loop_.rig);
    FaultedLanes plant(*this, place);
    FaultByKind(spec.kind).end(plant);
    AfterFault(place, plant);
  }
}

void SwitchingEngine::AfterFault(const FaultPlace& place, const FaultedPlant& changed) {
  BearingRun& b = bearings_[place.bearing];
  if (changed.sensor_changed()) b.side->plain_sensors = false;
  if (!changed.bridge_changed()) return;
  // The bridge changes in the middle of its period: rebuild this coil's voltage pattern.
  b.only_edge_moves = false;
  SetPattern(b, place.coil);
}

}  // namespace ambrig
