#pragma once
/// The true rig, assembled: every block with the seams that effects and faults may use.
/// Built by rig/rig_assembly.cc from parameters; the controller never sees it.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "actuators/electronics/adc.h"
#include "actuators/electronics/power_bridge.h"
#include "actuators/magnetics/flux_law.h"
#include "actuators/magnetics/stator_lanes.h"
#include "effects/bus_supply.h"
#include "rotor/motion/position_sensor.h"
#include "rotor/motion/rotor_model.h"
#include "rotor/motion/speed_sensor.h"

namespace ambrig {

/// What a coil-voltage term may depend on.
struct CoilCircumstance {
  double t = 0, current = 0, bus = 0, x = 0, y = 0;
  const MotionState* motion = nullptr;
};

/// Seam: extra voltage [V] in series with one coil, constant over a switching period.
class VoltageTerm {
 public:
  virtual ~VoltageTerm() = default;
  virtual double Voltage(const CoilCircumstance& c) const = 0;
};

/// Copper that warms up: R = R20 (1 + 0.00393 dT), tau dT' = rise P - dT. P is the coil's own loss,
/// and of the share that the stator's iron carries from coil to coil the mean loss of the bearing's
/// coils.
struct CoilHeating {
  double rise_per_watt = 0;  // [K/W], 0: none
  double time_constant = 1;  // [s]
  double shared = 0;         // 0: each coil on its own; 1: all coils equally warm
  std::array<double, kLanes> dT{};
};

struct BearingPlant {
  std::string name;
  double z = 0;  // [m]
  bool thrust = false, opposed = false;
  StatorLanes lanes;
  PlaneMap plane;  // where the magnets pull
  PositionSensor sensor;
  std::array<BridgeImperfection, kLanes> bridge{};
  std::array<CurrentSensor, kLanes> current_sensor{};
  std::vector<std::unique_ptr<FluxLaw>> laws;
  std::vector<std::unique_ptr<VoltageTerm>> voltage[kLanes];
  CoilHeating heating;
  Lane base_resistance;               // before heating
  double offset_x = 0, offset_y = 0;  // magnetic centre against the sensor's zero [m]
};

struct Plant {
  explicit Plant(RotorModel rotor_model) : rotor(std::move(rotor_model)) {}
  RotorModel rotor;
  std::vector<BearingPlant> bearings;
  /// (bearing, z) of every radial bearing, known before the bearings are built (shape hooks).
  std::vector<std::pair<std::string, double>> planes;
  /// The bus lives on the heap: a formula keeps its address while the plant moves.
  std::unique_ptr<BusSupply> bus_place = std::make_unique<BusSupply>();
  BusSupply& bus = *bus_place;
  /// Named planes of a beam rotor: disks, stations.
  std::vector<std::pair<std::string, PlaneMap>> stations;
  PowerBridge bridge;  // the law of every coil's bridge
  SpeedSensor speed_sensor;
  double loop_delay = 0;  // [s] set-points reach the current loops this much later

  BearingPlant* Find(const std::string& name) {
    for (BearingPlant& b : bearings)
      if (b.name == name) return &b;
    return nullptr;
  }
};

}  // namespace ambrig
