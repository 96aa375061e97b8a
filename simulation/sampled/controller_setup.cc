#include "simulation/sampled/controller_setup.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/linear/control_plant.h"
#include "control/interface/controller_kind.h"
#include "control/position/axis_groups.h"
#include "control/position/unbalance_control.h"
#include "core/base/errors.h"
#include "rig/magnet_inverse.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

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

/// The nominal rig as the synthesis of this controller models it at one speed.
SampledPlant ModelOf(const RigParameters& rig, const ControllerParameters& c, double speed,
                     const std::vector<CurrentMap>& maps) {
  RigParameters model = rig;
  if (c.model_modes >= 0 && static_cast<std::size_t>(c.model_modes) < model.modes.size())
    model.modes.resize(static_cast<std::size_t>(c.model_modes));
  SampledPlant plant =
      MakeControlPlant(model, ControlledAxes(rig), speed, nullptr, {c.planes, c.modes}, maps);
  // Coils that pull in no direction any more. SLICOT would end the program.
  if (!plant.A.allFinite() || !plant.B.allFinite())
    throw InputError(
        fmt::format("{}: no controller can be designed for the coils that are left", c.where));
  return plant;
}

/// `nominal` and `maps` must outlive the site.
ControllerSite SiteOf(const NominalRig& nominal, const ControllerParameters& c, double Ts,
                      const std::vector<CurrentMap>& maps) {
  const RigParameters& rig = *nominal;
  ControllerSite site;
  site.period = Ts;
  site.inertia_polar = rig.rotor.inertia_polar;
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    const BearingParameters& b = rig.bearings[k];
    if (b.controller) continue;
    ControllerSite::Bearing at{b.name, b.kind->two_axes, b.z, b.sensor.z, k, {}};
    for (int j = 0; j < b.coils(); ++j) at.coils.push_back(fmt::format("coil{}", j + 1));
    at.i_max = rig.amplifier.i_max;
    at.unipolar = rig.amplifier.quadrants < 3;
    const AmplifierParameters& a = rig.amplifier;
    if (a.voltage_mode)
      at.force_per_duty = ForceConstant(b) * BiasCurrent(rig, b) *
                          (SwingsBothWays(a.modulation) ? 2 : 1) * a.bus_voltage / a.kp;
    site.bearings.push_back(std::move(at));
    for (const std::string& name : b.Axes()) {
      site.axes.push_back(name);
      site.f_max.push_back(c.pid.f_max);
    }
  }
  site.plant = [&rig, &maps](const ControllerParameters& of, double speed) {
    return ModelOf(rig, of, speed, maps);
  };
  site.inverse = [&nominal](std::size_t bearing) {
    const auto share = WeightShares(*nominal)[bearing];
    const bool planar = nominal->bearings[bearing].kind->two_axes;
    return MagnetInverseOf(nominal, bearing, {share[0], planar ? share[1] : 0});
  };
  return site;
}

}  // namespace

std::vector<double> ForceLimits(const NominalRig& rig, const ControllerParameters& c) {
  std::vector<double> out;
  for (const Axis& a : AxesOf(*rig))
    out.push_back(a.bearing->controller ? a.bearing->controller->f_max : c.pid.f_max);
  return out;
}

std::unique_ptr<PositionController> MakeCentralController(const NominalRig& nominal,
                                                          const ControllerParameters& c,
                                                          std::vector<std::string>* axes,
                                                          const std::vector<CurrentMap>& maps) {
  const RigParameters& rig = *nominal;
  const double Ts = rig.periods_per_control() / rig.amplifier.switching_frequency;
  const ControllerSite site = SiteOf(nominal, c, Ts, maps);
  auto central = ControllerKindByName(c.kind).make(c, site);
  if (c.unbalance)
    central =
        std::make_unique<UnbalanceControl>(std::move(central), site.axes.size(), *c.unbalance, Ts);
  if (axes) *axes = site.axes;
  return central;
}

std::unique_ptr<PositionController> MakeController(const NominalRig& nominal,
                                                   const ControllerParameters& c,
                                                   const std::vector<CurrentMap>& maps) {
  const RigParameters& rig = *nominal;
  const auto axes = AxesOf(rig);
  const double Ts = rig.periods_per_control() / rig.amplifier.switching_frequency;
  if (c.IsPlainPid()) {
    std::vector<PidParameters> pid;
    for (const Axis& a : axes)
      pid.push_back(a.bearing->controller ? *a.bearing->controller : c.pid);
    return std::make_unique<DecentralisedPid>(std::move(pid), Ts);
  }
  const std::vector<std::size_t> own = ControlledAxes(rig);
  AxisGroup rest;
  std::vector<PidParameters> rest_pid;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    if (!axes[k].bearing->controller) continue;
    rest.axes.push_back(k);
    rest_pid.push_back(*axes[k].bearing->controller);
  }
  std::unique_ptr<PositionController> central = MakeCentralController(nominal, c, nullptr, maps);
  if (rest.axes.empty()) return central;
  rest.controller = std::make_unique<DecentralisedPid>(std::move(rest_pid), Ts);
  std::vector<AxisGroup> groups;
  groups.push_back({own, std::move(central)});
  groups.push_back(std::move(rest));
  return std::make_unique<AxisGroups>(std::move(groups));
}

std::unique_ptr<ControllerSwitch> MakeControllerSwitch(const NominalRig& rig) {
  std::vector<std::unique_ptr<PositionController>> all;
  all.push_back(MakeController(rig, rig->controller));
  std::vector<double> limits = ForceLimits(rig, rig->controller);
  for (const ControllerParameters& c : rig->other_controllers) {
    all.push_back(MakeController(rig, c));
    const auto more = ForceLimits(rig, c);
    for (std::size_t k = 0; k < limits.size(); ++k) limits[k] = std::max(limits[k], more[k]);
  }
  return std::make_unique<ControllerSwitch>(
      std::move(all), limits, rig->periods_per_control() / rig->amplifier.switching_frequency);
}

}  // namespace ambrig
