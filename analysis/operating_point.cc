#include "analysis/operating_point.h"

#include <fmt/format.h>

#include <cmath>

#include "simulation/continuous/equilibrium.h"

namespace ambrig {

namespace {

// Below this a run's start holds a coil at the bridge's lower limit (base_model.md section 3).
constexpr double kInterrupted = 0.2;  // [A]

std::size_t U(int k) { return static_cast<std::size_t>(k); }

Scenario AtRest() {
  Scenario s;
  s.name = "operating point";
  s.noise = false;
  s.record_rate = 1;
  return s;
}

void PlaceCoils(OperatingPoint& p, std::size_t k) {
  const BearingControl& control = p.sampled->control[k];
  const SampledBearing& b = p.sampled->bearings[k];
  const AmplifierParameters& amplifier = p.rig().amplifier;
  const double fx = p.force[b.first_axis], fy = b.axes > 1 ? p.force[b.first_axis + 1] : 0;
  const auto set = control.map.SetPoints(fx, fy);
  const Eigen::Vector3d command(control.map.c0, fx / (control.map.k * control.map.c0),
                                fy / (control.map.k * control.map.c0));
  const Eigen::VectorXd free = control.map.W * command;
  std::vector<CoilPoint> coils(U(control.coils));
  for (int j = 0; j < control.coils; ++j) {
    CoilPoint& c = coils[U(j)];
    c.current = set[j];
    c.commanded = set[j] == free[j];
    CurrentRegulator regulator(amplifier);
    regulator.HoldCurrent(std::max(c.current, 1.01 * kInterrupted), b.plant->base_resistance[j]);
    c.duty = regulator.DutyFromVoltage(regulator.integral());
    const std::string name = fmt::format("{}.coil{}", control.name, j + 1);
    if (!c.commanded)
      p.notes.push_back(
          fmt::format("{} carries {:.3g} A, a limit of its set-point: its current cannot follow "
                      "the force command",
                      name, c.current));
    else if (c.current <= kInterrupted && amplifier.quadrants < 3)
      p.notes.push_back(fmt::format(
          "{} carries {:.3g} A: a current that its diodes interrupt counts as continuous", name,
          c.current));
  }
  p.coils.push_back(coils);
}

void NoteWhatIsLeftOut(OperatingPoint& p) {
  for (const BearingPlant& b : p.plant().bearings) {
    if (!b.lanes.laws.empty())
      p.notes.push_back(
          fmt::format("bearing {}: effects of its iron are not in the linear model", b.name));
    if (!b.sensor.maps.empty())
      p.notes.push_back(fmt::format(
          "bearing {}: effects of its position sensors are not in the linear model", b.name));
    for (const CurrentSensor& s : b.current_sensor)
      if (s.gain != 1) {
        p.notes.push_back(fmt::format(
            "bearing {}: errors of its current sensors are not in the linear model", b.name));
        break;
      }
  }
  if (!p.plant().bus.stiff()) p.notes.push_back("the bus counts as stiff in the linear model");
}

}  // namespace

std::vector<std::string> OperatingPoint::Axes() const {
  std::vector<std::string> out;
  for (const BearingParameters& b : rig().bearings)
    for (const std::string& axis : b.Axes()) out.push_back(axis);
  return out;
}

OperatingPoint FindOperatingPoint(const RigParameters& rig) {
  OperatingPoint p;
  p.sampled = std::make_unique<SampledDataLoop>(rig, AtRest(), SampledOptions{});
  p.sampled->Start();
  const auto shares = WeightShares(p.rig());
  for (const SampledBearing& b : p.sampled->bearings)
    for (std::size_t side = 0; side < b.axes; ++side) p.force.push_back(shares[b.index][side]);
  const Equilibrium e = LevitatedEquilibrium(*p.sampled);
  if (e.usable()) {
    p.force = e.force;
    p.motion.q = e.q;
  } else {
    p.notes.push_back("no unique equilibrium (" + e.message + "): linearised at the centre");
  }
  for (std::size_t k = 0; k < p.sampled->bearings.size(); ++k) {
    PlaceCoils(p, k);
    const BearingPlant& b = p.plant().bearings[k];
    const auto [x, y] = p.plant().rotor.Position(p.motion, b.plane);
    Lane current{};
    for (int j = 0; j < b.lanes.coils; ++j) current[j] = p.coils[k][U(j)].current;
    p.bearings.push_back(LineariseBearing(b.lanes, current, x - b.offset_x, y - b.offset_y));
  }
  NoteWhatIsLeftOut(p);
  return p;
}

}  // namespace ambrig
