#include "analysis/linear/operating_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/linear/bridge_point.h"
#include "core/base/coil_name.h"
#include "core/base/index.h"
#include "rig/nominal_control.h"
#include "rig/rig_assembly.h"

namespace ambrig {

OperatingPoint::Model::Model(const TrueRig& true_rig, const NominalRig& known,
                             const std::vector<CurrentMap>& maps)
    : rig(true_rig), nominal(known), plant(BuildPlant(rig)) {
  for (std::size_t k = 0; k < plant.bearings.size(); ++k) {
    control.push_back(MakeBearingControl(nominal, k));
    if (!maps.empty()) control.back().map = maps[k];
  }
}

void OperatingPoint::PlaceCoils(std::size_t k) {
  const BearingControl& own = control()[k];
  const BearingPlant& bearing = plant().bearings[k];
  const AmplifierParameters& amplifier = rig().amplifier;
  const double* f = force.data() + FirstAxis(k);
  const double fx = f[0], fy = AxisCount(k) > 1 ? f[1] : 0;
  const auto set = own.map.SetPoints(fx, fy);
  const Eigen::Vector3d command(own.map.c0, fx / (own.map.k * own.map.c0),
                                fy / (own.map.k * own.map.c0));
  const Eigen::VectorXd free = own.map.W * command;
  std::vector<CoilPoint> placed(AsSize(own.coils));
  for (int j = 0; j < own.coils; ++j) {
    CoilPoint& c = placed[AsSize(j)];
    c.current = CarriedCurrent(amplifier, bearing, j, set[j]);
    c.commanded = set[j] == free[j];
    c.duty = HoldingDuty(k, j, std::max(c.current, 1.01 * kInterruptedCurrent));
    const std::string name = CoilName(own.name, j);
    if (!c.commanded)
      notes.push_back(
          fmt::format("{} carries {:.3g} A, a limit of its set-point: its current cannot follow "
                      "the force command",
                      name, c.current));
    else if (c.current <= kInterruptedCurrent && amplifier.quadrants < 3)
      notes.push_back(fmt::format(
          "{} carries {:.3g} A: a current that its diodes interrupt counts as continuous", name,
          c.current));
  }
  coils.push_back(placed);
}

double OperatingPoint::HoldingDuty(std::size_t bearing, int coil, double current) const {
  const BearingPlant& b = plant().bearings[bearing];
  const double volts = b.base_resistance[coil] * current;
  const double guess = CurrentRegulator(rig().amplifier).DutyFromVoltage(volts);
  return DutyForVoltage(rig().amplifier, b.bridge[AsSize(coil)], plant().bus.voltage, volts, guess);
}

void OperatingPoint::NoteWhatIsLeftOut() {
  for (const BearingPlant& b : plant().bearings)
    if (std::ranges::any_of(b.lanes.laws,
                            [&](const FluxLaw* law) { return !law->LinearAt(b.lanes.phi); }))
      notes.push_back(
          fmt::format("bearing {}: hysteresis of its iron is not in the linear model", b.name));
  if (!plant().bus.stiff()) notes.push_back("the bus counts as stiff in the linear model");
}

std::vector<std::string> OperatingPoint::Axes() const { return AxisNames(rig()); }

std::size_t OperatingPoint::FirstAxis(std::size_t bearing) const {
  std::size_t first = 0;
  for (std::size_t k = 0; k < bearing; ++k) first += AxisCount(k);
  return first;
}

std::size_t OperatingPoint::BearingOf(std::size_t axis) const {
  std::size_t k = 0;
  while (FirstAxis(k) + AxisCount(k) <= axis) ++k;
  return k;
}

OperatingPoint::OperatingPoint(const TrueRig& true_rig, const NominalRig& known,
                               const std::vector<CurrentMap>& maps)
    : force(WeightOverAxes(*true_rig)), model_(std::make_shared<Model>(true_rig, known, maps)) {
  const Equilibrium e = LevitatedEquilibrium(rig(), plant(), control(), EquilibriumOf::kTrueParts);
  if (e.usable()) {
    force = e.force;
    motion.q = e.q;
  } else {
    notes.push_back("no unique equilibrium (" + e.message + "): linearised at the centre");
  }
  for (std::size_t k = 0; k < plant().bearings.size(); ++k) {
    PlaceCoils(k);
    const BearingPlant& b = plant().bearings[k];
    const auto [x, y] = plant().rotor.Position(motion, b.plane);
    Lane current{};
    for (int j = 0; j < b.lanes.coils; ++j) current[j] = coils[k][AsSize(j)].current;
    bearings.push_back(LineariseBearing(b.lanes, current, x - b.offset_x, y - b.offset_y));
    const PlanePoint at = plant().rotor.Position(motion, b.sensor.map);
    sensors.push_back(LineariseSensor(b.sensor, motion, at.x, at.y));
  }
  NoteWhatIsLeftOut();
}

OperatingPoint FindOperatingPoint(const RigParameters& rig) {
  return {TrueRig(rig), NominalRig(rig)};
}

}  // namespace ambrig
