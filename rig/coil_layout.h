#pragma once
/// Where the coils of a bearing stand, for drawings of any stator.
#include <string>
#include <vector>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

struct CoilPlace {
  std::string name;  // "A.coil3", as faults name it
  double angle = 0;  // of its pull from the bearing's x axis, within ±π [rad]
  double turns = 0;  // signed [-]
  double gap = 0;    // rotor centred [m]
};

/// In the order of the coils.
std::vector<CoilPlace> CoilsOf(const BearingParameters& b);

}  // namespace ambrig
