#pragma once
/// A rig of one bearing with two axes and eight coils, and a controller on it.
#include <gtest/gtest.h>

#include "control/external/external_controller.h"

namespace ambrig::testing {

/// A module that cmake/tests.cmake builds from tests/control/external/controllers or
/// examples/controllers.
inline std::string Module(const std::string& name) {
  return std::string(AMBRIG_CONTROLLER_MODULES) + "/" + name + ".so";
}

inline ControllerSite SmallSite() {
  ControllerSite site;
  site.axes = {"A.x", "A.y"};
  site.f_max = {60, 50};
  site.period = 8e-5;
  ControllerSite::Bearing b;
  b.name = "A";
  for (int j = 1; j <= 8; ++j) b.coils.push_back("coil" + std::to_string(j));
  b.i_max = 6;
  site.bearings.push_back(b);
  return site;
}

inline ExternalSettings Library(
    const std::string& name, const std::vector<std::pair<std::string, double>>& parameters = {}) {
  ExternalSettings s;
  s.library = Module(name);
  s.name = name + ".so";
  s.where = "rig.toml:7: controller.file";
  for (const auto& [key, value] : parameters) {
    s.parameter_names.push_back(key);
    s.parameters.push_back(value);
  }
  return s;
}

}  // namespace ambrig::testing
