#include "simulation/sampled/command_plan.h"

#include <cmath>
#include <string>

#include "core/base/coil_name.h"
#include "rig/rig_figures.h"

namespace ambrig {

CommandPlan::CommandPlan(const RigParameters& rig, const Scenario& scenario) {
  const double pwm = rig.amplifier.switching_frequency;
  const int M = rig.periods_per_control();
  const auto periods = static_cast<std::size_t>(std::ceil(scenario.duration * pwm - 1e-9)) + 1;
  const auto add = [&](std::vector<Signal>& list, int bearing, int index, const Excitation& e,
                       bool tick) {
    Signal* signal = nullptr;
    for (Signal& s : list)
      if (s.bearing == bearing && s.index == index) signal = &s;
    const std::size_t step = tick ? static_cast<std::size_t>(M) : 1, count = periods / step + 1;
    if (!signal) {
      list.push_back({index, bearing, std::vector<double>(count, 0.0)});
      signal = &list.back();
    }
    // Instants are k periods; a start that falls on one (to rounding) counts as reached.
    for (std::size_t k = 0; k < count; ++k) {
      const double t = static_cast<double>(k * step) / pwm;
      signal->values[k] += e.Value(t + 1e-10);
    }
  };
  for (const Excitation& e : scenario.excitations) {
    int axis = 0;
    for (std::size_t b = 0; b < rig.bearings.size(); ++b) {
      const std::string prefix = rig.bearings[b].name + ".coil";
      for (const std::string& name : rig.bearings[b].Axes()) {
        if (name == e.target) add(e.port == "reference" ? reference : force, -1, axis, e, true);
        ++axis;
      }
      if (e.target.starts_with(prefix)) {
        const int coil = std::stoi(e.target.substr(prefix.size())) - 1;
        add(e.port == "duty" ? duty : current, static_cast<int>(b), coil, e, false);
      }
    }
  }
  const AmplifierParameters& a = rig.amplifier;
  for (std::size_t b = 0; b < rig.bearings.size(); ++b)
    for (int j = 0; j < rig.bearings[b].coils(); ++j) {
      const auto at = scenario.start_current.find(CoilName(rig.bearings[b].name, j));
      if (at == scenario.start_current.end()) continue;
      // In voltage mode a set-point is a voltage, over kp.
      const double per_ampere = a.voltage_mode ? CoilResistance(rig.bearings[b]) / a.kp : 1;
      start.push_back({j, static_cast<int>(b), at->second, per_ampere * at->second});
    }
  const auto index_of = [&rig](const std::string& name) {
    std::size_t index = 0;
    for (std::size_t k = 0; k < rig.other_controllers.size(); ++k)
      if (rig.other_controllers[k].name == name) index = k + 1;
    return index;
  };
  for (const SwitchSpec& s : scenario.switches)
    switches.push_back(
        {static_cast<long long>(std::ceil(s.time * pwm / M - 1e-9)), index_of(s.to)});
  if (!scenario.retuned_controller.empty()) retuned = index_of(scenario.retuned_controller);
}

}  // namespace ambrig
