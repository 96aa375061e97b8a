#pragma once
/// The controller's side of one bearing: its current map, one current loop per coil, and what is
/// commanded and fed back.
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <string>

#include "actuators/magnetics/lane.h"
#include "control/current/current_map.h"
#include "control/current/current_regulators.h"
#include "control/current/current_transition.h"

namespace ambrig {

struct BearingControl {
  std::string name;
  int coils = 0;
  CurrentMap map;
  std::shared_ptr<CurrentTransition>
      current_transition;  // on the way to `map`'s currents; empty: there
  CurrentRegulators regulator;
  Lane set_point;                       // in force, without excitation [A]
  Lane commanded;                       // with the coil's current excitation [A]
  Lane duty, feedback;                  // of this period [-]; mean of the last period's samples [A]
  std::array<bool, kLanes> disabled{};  // bridge kept off by the controller
  /// As one number: the comparison of arrays is a call of the C library's memcmp.
  bool AnyDisabled() const {
    static_assert(sizeof disabled == sizeof(std::uint64_t));
    return std::bit_cast<std::uint64_t>(disabled) != 0;
  }
  Lane probe;  // 0, or what a coil's loop follows instead of `commanded` [A]
};

}  // namespace ambrig
