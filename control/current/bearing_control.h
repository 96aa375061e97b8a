#pragma once
/// The controller's side of one bearing: its current map, one current loop per coil, and what is
/// commanded and fed back.
#include <array>
#include <memory>
#include <string>

#include "actuators/magnetics/lane.h"
#include "control/current/current_map.h"
#include "control/current/current_regulator.h"
#include "control/current/current_transition.h"

namespace ambrig {

struct BearingControl {
  std::string name;
  int coils = 0;
  CurrentMap map;
  std::shared_ptr<CurrentTransition>
      current_transition;  // on the way to `map`'s currents; empty: there
  std::array<CurrentRegulator, kLanes> regulator;
  Lane set_point;                       // in force, without excitation [A]
  Lane commanded;                       // with the coil's current excitation [A]
  Lane duty, feedback;                  // of this period [-]; mean of the last period's samples [A]
  std::array<bool, kLanes> disabled{};  // bridge kept off by the controller
  Lane probe;  // 0, or what a coil's loop follows instead of `commanded` [A]
};

}  // namespace ambrig
