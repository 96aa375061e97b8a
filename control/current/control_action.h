#pragma once
/// What a supervisor may ask of the controller: the only ways in which fault detection acts on a
/// run. The engine applies them between two switching periods.
#include <cstddef>
#include <memory>
#include <variant>
#include <vector>

#include "control/current/bearing_control.h"

namespace ambrig {

/// The coil's bridge is kept off from the next period on.
struct DisableCoil {
  std::size_t bearing = 0;
  int coil = 0;
};

/// The coil's bridge works again.
struct EnableCoil {
  std::size_t bearing = 0;
  int coil = 0;
};

/// The coil's bridge works and its loop follows this current instead of the map's set-point; 0: the
/// probe is over, the bridge is kept off.
struct ProbeCoil {
  std::size_t bearing = 0;
  int coil = 0;
  double current = 0;  // [A]
};

/// Another map from forces to set-points, and the way of the set-points there (empty: at once).
struct ReplaceMap {
  std::size_t bearing = 0;
  CurrentMap map;
  std::shared_ptr<CurrentTransition> current_transition;
  CoilVector turns_left = CoilVector::Ones();  // share of each coil's turns that the map counts on
};

/// Another integral of a coil's current regulator.
struct SetIntegral {
  std::size_t bearing = 0;
  int coil = 0;
  double volts = 0;  // [V]
};

using ControlAction = std::variant<DisableCoil, EnableCoil, ProbeCoil, ReplaceMap, SetIntegral>;

/// Carries out one action on the controller of the rig, one entry of `control` per bearing.
void Apply(const ControlAction& action, std::vector<BearingControl>& control);

}  // namespace ambrig
