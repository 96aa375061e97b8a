#pragma once
/// The rotor without its controller: free, on springs that stand for the bearings, and over a range
/// of spring stiffnesses.
///   free       M q'' + (D + Ω G) q' + K q = 0
///   supported  K + Σ B k gap, k = k_p - k_s: the controller's proportional gain less the bearing's
///              negative stiffness; undamped, so that frequencies are those of modes, not of poles
///   map        the same with every radial bearing at one common k (undamped critical speed map)
/// Radial coordinates only. A beam counts whole (up to 60 bending modes of the free shaft),
/// whatever `modes` its runs in time keep; only a rotor on a base or on mounts has the modes of its
/// runs. Source: docs/theory/rotor.md; API 684 for the map.
#include "analysis/linear/linear_plant.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {

struct RotorMode {
  double frequency = 0;   // [Hz]
  double whirl = 0;       // as rotor/shaft/rotor_modes.h
  std::vector<double> z;  // stations [m]
  std::vector<double> x;  // displacement there, largest 1
};

struct SupportStiffness {
  std::string bearing;
  double proportional = 0, negative = 0;  // k_p of its controller, k_s (mean of both axes) [N/m]
  double net() const { return proportional - negative; }
};

struct RotorOnSupports {
  std::vector<SupportStiffness> supports;  // radial bearings
  std::vector<RotorMode> free, supported;  // at rest, one of each pair of planes
  std::vector<CriticalSpeed> critical;     // undamped, of the supported rotor; empty if k <= 0
  std::vector<CriticalMapRow> map;
};

/// `modes` of each kind.
RotorOnSupports AnalyseSupports(const OperatingPoint& point, int modes);

}  // namespace ambrig
