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

Plant BuildPlant(const RigParameters& rig) {
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

namespace {
unsigned ActsOnBit(BearingKind kind) {
  return kind == BearingKind::kRadial   ? kOnRadial
         : kind == BearingKind::kThrust ? kOnThrust
                                        : kOnOpposed;
}
}  // namespace

EffectTargets TargetsOfEffects(const RigParameters& rig) {
  EffectTargets known;
  for (const ShaftPlane& s : rig.stations) known.stations.push_back(s.name);
  for (const auto& b : rig.bearings) {
    known.planes.push_back(b.kind == BearingKind::kThrust ? "z" : b.name);
    known.bearings.push_back(b.name);
    for (int j = 1; j <= b.coils(); ++j)
      known.coils.push_back(b.name + ".coil" + std::to_string(j));
    for (const auto& axis : b.Axes()) known.axes.push_back(axis);
    const unsigned kind = ActsOnBit(b.kind);
    known.kind[b.name] = known.kind[known.planes.back()] = kind;
    for (int j = 1; j <= b.coils(); ++j) known.kind[b.name + ".coil" + std::to_string(j)] = kind;
    for (const auto& axis : b.Axes()) known.kind[axis] = kind;
  }
  return known;
}

double ForceConstant(const BearingParameters& b) {
  switch (b.kind) {
    case BearingKind::kRadial:
      return RadialStator(b.radial).ForceConstant();
    case BearingKind::kThrust:
      return 4 * kMu0 * b.thrust.turns * b.thrust.turns * b.thrust.pole_area /
             (b.thrust.gap * b.thrust.gap);
    case BearingKind::kOpposed: {
      // f = (1/2) (c0 + v)² L' - (1/2) (c0 - v)² L' = 2 c0 v L', one coil alone: c0 v L' about c0.
      const auto& p = b.opposed;
      const double slope =
          p.inductance_near / (p.gap_constant * std::pow(1 + p.gap / p.gap_constant, 2));
      return (p.coils > 1 ? 2 : 1) * slope;
    }
  }
  return 0;
}

double BiasCurrent(const RigParameters& rig, const BearingParameters& b) {
  if (b.kind == BearingKind::kThrust) return b.thrust.bias_current;
  if (b.kind == BearingKind::kOpposed && b.opposed.bias_current > 0) return b.opposed.bias_current;
  return rig.controller.bias_current;
}

std::vector<int> CoilsOf(const RigParameters& rig) {
  std::vector<int> out;
  for (const BearingParameters& b : rig.bearings) out.push_back(b.coils());
  return out;
}

const PidParameters& PidOf(const RigParameters& rig, const BearingParameters& b) {
  return b.controller ? *b.controller : rig.controller.pid;
}

std::vector<std::array<double, 2>> WeightShares(const RigParameters& rig) {
  // Least-norm forces f_k with Σ f = -m g and Σ z f = 0; exact for two bearings.
  double n = 0, sz = 0, szz = 0;
  for (const auto& b : rig.bearings)
    if (b.kind == BearingKind::kRadial) {
      n += 1;
      sz += b.z;
      szz += b.z * b.z;
    }
  std::vector<std::array<double, 2>> out;
  const double m = rig.rotor.mass;
  for (const auto& b : rig.bearings) {
    if (b.kind == BearingKind::kRadial) {
      const double share = (szz - b.z * sz) / (n * szz - sz * sz);
      out.push_back({-m * rig.gravity[0] * share, -m * rig.gravity[1] * share});
    } else if (b.kind == BearingKind::kThrust) {
      out.push_back({-m * rig.gravity[2], 0});
    } else {
      const double a = b.opposed.angle_deg * kPi / 180;
      out.push_back({-m * (rig.gravity[0] * std::cos(a) + rig.gravity[1] * std::sin(a)), 0});
    }
  }
  return out;
}

double RecordRateFor(const RigParameters& rig, double rate) {
  const double pwm = rig.amplifier.switching_frequency;
  const int k = rig.samples_per_period();
  if (rate <= pwm * (1 + 1e-9)) return pwm / std::max(1.0, std::floor(pwm / rate + 1e-6));
  for (int part = 2; part <= k; ++part)
    if (k % part == 0 && pwm * part >= rate * (1 - 1e-9)) return pwm * part;
  return pwm * k;
}

std::vector<double> WeightOverAxes(const RigParameters& rig) {
  std::vector<double> force;
  const auto shares = WeightShares(rig);
  for (std::size_t k = 0; k < rig.bearings.size(); ++k)
    for (std::size_t side = 0; side < rig.bearings[k].Axes().size(); ++side)
      force.push_back(shares[k][side]);
  return force;
}

}  // namespace ambrig
