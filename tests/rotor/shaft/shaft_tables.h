#pragma once
/// A [rotor] of kind "beam" with every table, and how it is read.
#include <string>
#include <vector>

#include "rotor/shaft/beam_file.h"

namespace ambrig::testing {

inline const char* const kShaftTables = R"([rotor]
kind = "beam"
modes = 2
modal_damping = [0.001, 0.002]
elements_per_section = 3
stations = [0.07]
[rotor.materials.m300]
E = { value = 1.9e11, sd = 2e9 }
rho = 8000.0
nu = 0.3
[[rotor.section]]
length = 0.1
od = 0.02
material = "m300"
[[rotor.section]]
length = 0.2
od = 0.03
od_right = 0.02
id = 0.01
E = 2.1e11
rho = 7850
[[rotor.sleeve]]
z0 = 0.02
length = 0.05
id = 0.02
od = 0.04
rho = 7650
[[rotor.disk]]
z = 0.2
width = 0.02
id = 0.026
od = 0.1
material = "steel"
name = "wheel"
[[rotor.disk]]
z = 0.3
mass = 0.5
inertia_diametral = 1e-4
inertia_polar = 2e-4
[[rotor.support]]
z = 0
k = 1e6
c = 10
kyy = 2e6
)";

inline BeamFile ParseShaft(const std::string& text, std::vector<Tolerance>* tolerances = nullptr) {
  return ReadBeam(*TomlTable::FromText(text, "rig.toml").Table("rotor"), tolerances);
}

inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// What ParseShaft says to a mistake.
inline std::string ShaftMessage(const std::string& text) {
  try {
    ParseShaft(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace ambrig::testing
