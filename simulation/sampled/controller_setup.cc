#include "simulation/sampled/controller_setup.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/linear/control_plant.h"
#include "control/position/axis_groups.h"
#include "control/position/filtered_pid.h"
#include "control/position/state_space_controller.h"
#include "control/synthesis/h_infinity.h"
#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

struct Axis {
  std::string name;
  const BearingParameters* bearing = nullptr;
};

std::vector<Axis> AxesOf(const RigParameters& rig) {
  std::vector<Axis> axes;
  for (const BearingParameters& b : rig.bearings)
    for (const std::string& name : b.Axes()) axes.push_back({name, &b});
  return axes;
}

bool Names(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

PidSchedule ScheduleOf(const ControllerParameters& c) {
  PidSchedule s{{0}, {c.pid}};
  if (c.schedule.empty()) return s;
  s.speeds.clear();
  s.points.clear();
  for (const PidPoint& point : c.schedule) {
    PidParameters p = c.pid;
    p.kp = point.kp;
    p.kd = point.kd;
    p.ki = point.ki;
    s.speeds.push_back(point.speed);
    s.points.push_back(p);
  }
  return s;
}

std::unique_ptr<PositionController> MakePid(const ControllerParameters& c,
                                            const std::vector<std::string>& names, double Ts) {
  if (c.filters.empty() && c.schedule.empty())
    return std::make_unique<DecentralisedPid>(std::vector<PidParameters>(names.size(), c.pid), Ts);
  std::vector<FilteredPidAxis> axes;
  for (const std::string& name : names) {
    FilteredPidAxis axis{ScheduleOf(c), {}};
    for (const FilterParameters& f : c.filters)
      if (f.axes.empty() || Names(f.axes, name)) axis.filters.push_back(SampleFilter(f, Ts));
    axes.push_back(axis);
  }
  return std::make_unique<FilteredPid>(std::move(axes), Ts);
}

StateSpace TransfersOf(const ControllerParameters& c, const std::vector<std::string>& names) {
  std::vector<StateSpace> parts;
  for (const std::string& name : names) {
    const AxisSystem* found = nullptr;
    for (const AxisSystem& a : c.transfers)
      if (Names(a.axes, name) || (a.axes.empty() && !found)) found = &a;
    Require(found != nullptr, "a transfer function for every axis");
    parts.push_back(found->system);
  }
  return Append(parts);
}

std::unique_ptr<PositionController> MakeTiltTranslation(const RigParameters& rig,
                                                        const ControllerParameters& c,
                                                        const std::vector<double>& f_max,
                                                        double Ts) {
  TiltTranslationGeometry g;
  g.inertia_polar = rig.rotor.inertia_polar;
  for (const BearingParameters& b : rig.bearings) {
    if (b.controller) continue;
    if (b.kind != BearingKind::kRadial)
      throw InputError(
          fmt::format("{}: kind = \"tilt-translation\", but bearing {} is not radial; allowed: its "
                      "own controller, "
                      "[bearings.{}.controller]",
                      c.where, b.name, b.name));
    g.sensor_z.push_back(b.sensor.z);
    g.bearing_z.push_back(b.z);
  }
  if (g.sensor_z.size() < 2)
    throw InputError(
        fmt::format("{}: kind = \"tilt-translation\", allowed: with two radial bearings or more "
                    "that it controls",
                    c.where));
  return std::make_unique<TiltTranslation>(c.translation, c.tilt, c.gyroscopic_compensation, g,
                                           f_max, Ts);
}

/// The nominal rig as the synthesis of this controller models it, one plant per speed.
std::vector<SampledPlant> ModelsOf(const RigParameters& rig, const ControllerParameters& c,
                                   const std::vector<std::size_t>& axes) {
  RigParameters model = rig;
  if (c.model_modes >= 0 && static_cast<std::size_t>(c.model_modes) < model.modes.size())
    model.modes.resize(static_cast<std::size_t>(c.model_modes));
  std::vector<SampledPlant> plants;
  for (const double speed : c.speeds)
    plants.push_back(MakeControlPlant(model, axes, speed, nullptr, {c.planes, c.modes}));
  return plants;
}

std::unique_ptr<PositionController> MakeCentral(const RigParameters& rig,
                                                const ControllerParameters& c,
                                                const std::vector<std::size_t>& axes,
                                                const std::vector<std::string>& names,
                                                const std::vector<double>& f_max, double Ts) {
  if (c.kind == "transfer-function")
    return std::make_unique<StateSpaceController>(
        std::vector<double>{0}, std::vector<StateSpace>{TransfersOf(c, names)}, f_max);
  if (c.kind == "state-space") {
    std::vector<double> speeds;
    std::vector<StateSpace> points;
    for (const SystemPoint& s : c.systems) {
      speeds.push_back(s.speed);
      points.push_back(s.system);
    }
    return std::make_unique<StateSpaceController>(speeds, points, f_max);
  }
  if (c.kind == "lqg") {
    std::vector<LqgDesign> designs;
    for (const SampledPlant& plant : ModelsOf(rig, c, axes))
      designs.push_back(DesignLqg(plant, c.lqg, c.where));
    return std::make_unique<LqgController>(c.speeds, std::move(designs), f_max, Ts);
  }
  if (c.kind == "h-infinity") {
    std::vector<StateSpace> points;
    for (const SampledPlant& plant : ModelsOf(rig, c, axes)) {
      // of readings; StateSpaceController works on e = -y
      StateSpace k = DesignHInfinity(plant, c.h_infinity, c.where).controller;
      k.B = -k.B;
      k.D = -k.D;
      points.push_back(std::move(k));
    }
    return std::make_unique<StateSpaceController>(c.speeds, points, f_max);
  }
  Require(c.kind == "tilt-translation", "a known kind");
  return MakeTiltTranslation(rig, c, f_max, Ts);
}

}  // namespace

std::vector<double> ForceLimits(const RigParameters& rig, const ControllerParameters& c) {
  std::vector<double> out;
  for (const Axis& a : AxesOf(rig))
    out.push_back(a.bearing->controller ? a.bearing->controller->f_max : c.pid.f_max);
  return out;
}

std::unique_ptr<PositionController> MakeController(const RigParameters& rig,
                                                   const ControllerParameters& c) {
  const auto axes = AxesOf(rig);
  const double Ts = rig.periods_per_control() / rig.amplifier.switching_frequency;
  if (c.IsPlainPid()) {
    std::vector<PidParameters> pid;
    for (const Axis& a : axes)
      pid.push_back(a.bearing->controller ? *a.bearing->controller : c.pid);
    return std::make_unique<DecentralisedPid>(std::move(pid), Ts);
  }
  const std::vector<std::size_t> own = ControlledAxes(rig);
  std::vector<std::string> names;
  std::vector<double> limits;
  AxisGroup rest;
  std::vector<PidParameters> rest_pid;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    if (!axes[k].bearing->controller) {
      names.push_back(axes[k].name);
      limits.push_back(c.pid.f_max);
      continue;
    }
    rest.axes.push_back(k);
    rest_pid.push_back(*axes[k].bearing->controller);
  }
  std::unique_ptr<PositionController> central =
      c.kind == "pid" ? MakePid(c, names, Ts) : MakeCentral(rig, c, own, names, limits, Ts);
  if (c.unbalance)
    central = std::make_unique<UnbalanceControl>(std::move(central), own.size(), *c.unbalance, Ts);
  if (rest.axes.empty()) return central;
  rest.controller = std::make_unique<DecentralisedPid>(std::move(rest_pid), Ts);
  std::vector<AxisGroup> groups;
  groups.push_back({own, std::move(central)});
  groups.push_back(std::move(rest));
  return std::make_unique<AxisGroups>(std::move(groups));
}

std::unique_ptr<ControllerSwitch> MakeControllerSwitch(const RigParameters& rig) {
  std::vector<std::unique_ptr<PositionController>> all;
  all.push_back(MakeController(rig, rig.controller));
  std::vector<double> limits = ForceLimits(rig, rig.controller);
  for (const ControllerParameters& c : rig.other_controllers) {
    all.push_back(MakeController(rig, c));
    const auto more = ForceLimits(rig, c);
    for (std::size_t k = 0; k < limits.size(); ++k) limits[k] = std::max(limits[k], more[k]);
  }
  return std::make_unique<ControllerSwitch>(
      std::move(all), limits, rig.periods_per_control() / rig.amplifier.switching_frequency);
}

}  // namespace ambrig
