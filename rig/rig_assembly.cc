#include "rig/rig_assembly.h"

#include <algorithm>
#include <cmath>

#include "effects/catalogue.h"
#include "rotor/motion/linear_rotor.h"

namespace ambrig {

namespace {

void FillRadial(const BearingParameters& b, StatorLanes& lanes) {
  const RadialStator stator(b.radial);
  lanes.coupling = Coupling::kFloatingRotor;
  lanes.coils = kPoles;
  lanes.reluctance.per_metre = 1 / (kMu0 * b.radial.pole_area);
  lanes.reluctance.gap0 = b.radial.gap;
  for (int j = 0; j < kPoles; ++j) {
    lanes.n[j] = stator.sense()[j] * b.radial.turns;
    lanes.leakage[j] = b.radial.leakage_inductance;
    lanes.resistance[j] = b.radial.resistance;
    lanes.direction_x[j] = stator.cosine()[j];
    lanes.direction_y[j] = stator.sine()[j];
    lanes.gap_offset[j] = b.radial.gap;
  }
}

void FillThrust(const BearingParameters& b, StatorLanes& lanes) {
  lanes.coupling = Coupling::kSides;
  lanes.coils = kThrustCoils;
  lanes.reluctance.per_metre = 2 / (kMu0 * b.thrust.pole_area);
  lanes.reluctance.gap0 = b.thrust.gap;
  for (int j = 0; j < kThrustCoils; ++j) {
    lanes.n[j] = b.thrust.turns;
    lanes.leakage[j] = b.thrust.leakage_inductance;
    lanes.resistance[j] = b.thrust.resistance;
    lanes.direction_x[j] = j < 2 ? 1 : -1;  // along z
    lanes.gap_offset[j] = b.thrust.gap;
  }
}

void FillOpposed(const BearingParameters& b, StatorLanes& lanes) {
  const OpposedStatorParameters& p = b.opposed;
  lanes.coupling = Coupling::kNone;
  lanes.coils = b.coils();
  // One "turn": N² P(g) = L_0/(1 + g/g_c).
  lanes.reluctance.per_metre = 1 / (p.gap_constant * p.inductance_near);
  lanes.reluctance.offset = 1 / p.inductance_near;
  lanes.reluctance.gap0 = p.gap;
  for (int j = 0; j < lanes.coils; ++j) {
    lanes.n[j] = 1;
    lanes.leakage[j] = p.inductance_far;
    lanes.resistance[j] = p.resistance;
    lanes.direction_x[j] = j == 0 ? 1 : -1;
    lanes.gap_offset[j] = p.gap;
  }
}

PlaneMap PlaneOf(const BearingParameters& b, const RotorModel& rotor, double z) {
  if (b.kind == BearingKind::kRadial) return rotor.MakePlane(z);
  PlaneMap map;
  map.z = z;
  if (b.kind == BearingKind::kThrust) {
    map.Add(2, 1, 0);
  } else {
    const double a = b.opposed.angle_deg * kPi / 180;
    map.Add(0, std::cos(a), 0);
    map.Add(1, std::sin(a), 0);
  }
  return map;
}

BearingPlant MakeBearing(const RigParameters& rig, const BearingParameters& b, RotorModel& rotor) {
  BearingPlant plant;
  plant.name = b.name;
  plant.z = b.z;
  plant.thrust = b.kind == BearingKind::kThrust;
  plant.opposed = b.kind == BearingKind::kOpposed;
  plant.plane = PlaneOf(b, rotor, b.z);
  plant.sensor.map = PlaneOf(b, rotor, b.sensor.z);
  plant.sensor.noise = b.sensor.noise;
  for (int j = 0; j < kLanes; ++j) {
    plant.lanes.gap_offset[j] = 1;  // inert lanes: harmless numbers
    plant.lanes.leakage[j] = 1;
  }
  switch (b.kind) {
    case BearingKind::kRadial:
      FillRadial(b, plant.lanes);
      break;
    case BearingKind::kThrust:
      FillThrust(b, plant.lanes);
      break;
    case BearingKind::kOpposed:
      FillOpposed(b, plant.lanes);
      break;
  }
  plant.lanes.unipolar = rig.amplifier.quadrants < 3;
  plant.base_resistance = plant.lanes.resistance;
  if (b.auxiliary && b.kind == BearingKind::kRadial)
    rotor.AddAuxiliary(b.name, std::isnan(b.auxiliary_z) ? b.z : b.auxiliary_z, *b.auxiliary);
  if (b.auxiliary && b.kind == BearingKind::kThrust) rotor.SetAxialStop(*b.auxiliary);
  return plant;
}

}  // namespace

Plant BuildPlant(const TrueRig& true_rig) {
  const RigParameters& rig = *true_rig;
  Plant plant(RotorModel(rig.rotor, rig.gravity));
  std::vector<std::pair<const EffectDescription*, const EffectInstance*>> live;
  for (const EffectInstance& e : rig.effects)
    if (!e.IsNull()) live.emplace_back(FindEffect(e.name), &e);
  for (const BendingMode& mode : rig.modes) plant.rotor.AddBendingMode(mode);
  for (const BearingParameters& b : rig.bearings)
    if (b.kind == BearingKind::kRadial) plant.planes.emplace_back(b.name, b.z);
  for (const auto& [description, instance] : live)
    if (description->shape) description->shape(*instance, plant);
  plant.bus.source = plant.bus.voltage = rig.amplifier.bus_voltage;
  plant.bridge = PowerBridge(rig.amplifier);
  plant.speed_sensor = SpeedSensor(rig.speed_sensor);
  for (const BearingParameters& b : rig.bearings) {
    if (b.kind == BearingKind::kThrust) plant.rotor.axial_free = true;
    plant.bearings.push_back(MakeBearing(rig, b, plant.rotor));
  }
  for (const ShaftPlane& s : rig.stations)
    plant.stations.emplace_back(s.name, plant.rotor.MakePlane(s.z));
  for (const auto& [description, instance] : live)
    if (description->apply) description->apply(*instance, plant);
  const double h = 1 / (rig.amplifier.switching_frequency * rig.samples_per_period());
  for (BearingPlant& b : plant.bearings) {
    for (const auto& law : b.laws) b.lanes.laws.push_back(law.get());
    b.lanes.SetStep(h);
  }
  return plant;
}

LinearRotor LinearRotorOf(const Plant& plant, double speed) {
  LinearRotor out = Linearise(plant.rotor, speed);
  for (const BearingPlant& b : plant.bearings) {
    const Eigen::Index axes = b.thrust || b.opposed ? 1 : 2;
    LinearPort port;
    port.name = b.name;
    port.z = b.plane.z;
    port.sensor_z = b.sensor.map.z;
    port.gap = PlaneRows(plant.rotor, b.plane).topRows(axes);
    port.C = PlaneRows(plant.rotor, b.sensor.map).topRows(axes);
    port.B = b.thrust ? Eigen::MatrixXd(port.gap.transpose())
                      : Eigen::MatrixXd(ForceColumns(plant.rotor, b.plane).leftCols(axes));
    out.ports.push_back(std::move(port));
  }
  return out;
}

}  // namespace ambrig
