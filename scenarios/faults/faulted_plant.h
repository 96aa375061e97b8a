#pragma once
/// The one seam between faults and the engines: the running plant at the instant of a fault, seen
/// from the fault's place. Sensors, bridges and the bus are the same in every fidelity; how a
/// coil's circuit breaks or shorts is the engine's own, which derives from this class.
#include "effects/plant.h"
#include "rig/parameters/rig_parameters.h"
#include "scenarios/faults/fault.h"

namespace ambrig {

/// Where a fault sits: a coil of a bearing, or a reading (side 0: x or z, 1: y) of it; -1: not
/// there.
struct FaultPlace {
  std::size_t bearing = 0;
  int coil = -1, side = -1;
};
FaultPlace PlaceOf(const FaultSpec& fault, const RigParameters& rig);

class FaultedPlant {
 public:
  /// `nominal_bus`: of the rig [V].
  FaultedPlant(Plant& plant, const FaultPlace& place, double nominal_bus)
      : plant_(plant), place_(place), nominal_bus_(nominal_bus) {}
  virtual ~FaultedPlant() = default;

  // Of the coil.
  virtual double Current() const = 0;  // now [A]
  virtual void BreakCoil() = 0;        // the current is gone within one ADC sample and stays away
  /// A fraction of the turns that are still driven, closed by `resistance` [ohm]; infinite:
  /// bypassed.
  virtual void ShortTurns(double fraction, double resistance) = 0;
  BridgeImperfection& Bridge();
  CurrentSensor& CoilSensor();

  /// Of the axis.
  SensorFault& Reading();

  // Of the rig.
  double nominal_bus() const { return nominal_bus_; }  // [V]
  void SetBus(double volts);

  // What the engine must set again afterwards.
  bool bridge_changed() const { return bridge_changed_; }
  bool sensor_changed() const { return sensor_changed_; }
  bool bus_changed() const { return bus_changed_; }

 protected:
  BearingPlant& bearing() { return plant_.bearings[place_.bearing]; }

  Plant& plant_;
  const FaultPlace place_;

 private:
  double nominal_bus_;  // [V]
  bool bridge_changed_ = false, sensor_changed_ = false, bus_changed_ = false;
};

}  // namespace ambrig
