#include "rig/rig_assembly.h"

#include <algorithm>
#include <cmath>

#include "effects/catalogue.h"
#include "rig/parameters/bearing_kind.h"
#include "rotor/motion/linearise.h"
#include "rotor/shaft/support_term.h"

namespace ambrig {

namespace {

constexpr double kGapOfNoPole = 1e20;  // [m], of lanes without a coil: no flux passes there

BearingPlant MakeBearing(const RigParameters& rig, const BearingParameters& b, RotorModel& rotor) {
  BearingPlant plant;
  plant.name = b.name;
  plant.z = b.z;
  const BearingKind& kind = *b.kind;
  plant.thrust = kind.axial;
  plant.opposed = !kind.axial && !kind.two_axes;
  plant.plane = kind.plane(b, rotor, b.z);
  plant.sensor.map = kind.plane(b, rotor, b.sensor.z);
  plant.sensor.noise = b.sensor.noise;
  const StatorGeometry stator = kind.stator(b);
  static_cast<StatorGeometry&>(plant.lanes) = PoleByPole(stator).value_or(stator);
  for (int j = plant.lanes.coils; j < kLanes; ++j) {
    plant.lanes.gap_offset[j] = kGapOfNoPole;
    plant.lanes.leakage[j] = 1;
  }
  plant.lanes.unipolar = rig.amplifier.quadrants < 3;
  plant.base_resistance = plant.lanes.resistance;
  for (std::size_t j = 0; j < b.coil_errors.current_gain.size(); ++j)
    plant.current_sensor[j].gain = 1 + b.coil_errors.current_gain[j];
  for (std::size_t j = 0; j < b.coil_errors.edge.size(); ++j)
    plant.bridge[j].late_edge = b.coil_errors.edge[j];
  if (b.auxiliary && kind.add_auxiliary) kind.add_auxiliary(b, rotor);
  return plant;
}

}  // namespace

Plant BuildPlant(const TrueRig& true_rig) {
  const RigParameters& rig = *true_rig;
  Plant plant(RotorModel(rig.rotor, rig.gravity));
  std::vector<std::pair<const EffectDescription*, const EffectInstance*>> live;
  for (const EffectInstance& e : rig.effects)
    if (!e.IsNull()) live.emplace_back(FindEffect(e.name), &e);
  // In the catalogue's order: a law takes numbers of the plant that later effects change, so that a
  // rig would depend on the order in which its file names them.
  std::stable_sort(live.begin(), live.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const BendingMode& mode : rig.modes) plant.rotor.AddBendingMode(mode);
  for (const BearingParameters& b : rig.bearings)
    if (b.kind->two_axes) plant.planes.emplace_back(b.name, b.z);
  for (const auto& [description, instance] : live)
    if (description->shape) description->shape(*instance, plant);
  plant.bus.Start(rig.amplifier.bus_voltage);
  plant.bridge = PowerBridge(rig.amplifier);
  plant.loop_delay = rig.amplifier.delay;
  plant.speed_sensor = SpeedSensor(rig.speed_sensor);
  for (const BearingParameters& b : rig.bearings) {
    if (b.kind->axial) plant.rotor.axial_free = true;
    plant.bearings.push_back(MakeBearing(rig, b, plant.rotor));
  }
  for (const ShaftPlane& s : rig.stations)
    plant.stations.emplace_back(s.name, plant.rotor.MakePlane(s.z));
  if (rig.beam)
    for (const SpringSupport& s : rig.beam->definition.supports)
      plant.rotor.terms.push_back(
          std::make_unique<SupportTerm>(plant.rotor.MakePlane(s.z - rig.z_origin), s));
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
