#pragma once
/// What distinguishes the kinds of bearing, one file per kind beside this one: axes, keys of
/// the rig file, nominal figures, and the parts of the plant. The rest of rig/ asks this table.
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "effects/plant.h"
#include "rig/rig_parameters.h"

namespace ambrig {

struct BearingKindTable {
  BearingKind kind;
  std::string_view name;  // as files write it
  unsigned acts_on;       // its bit of ActsOn
  bool axial;             // acts along the shaft; a plane of this kind is called "z"

  /// Names of the controlled axes.
  std::vector<std::string> (*axes)(const BearingParameters& b);
  /// The stator's keys.
  void (*read)(const TomlTable& t, BearingParameters& b, std::vector<Tolerance>* tolerances);
  void (*document)(std::vector<ParameterRow>& rows);

  double (*gap)(const BearingParameters& b);              // rotor centred [m]
  double (*coil_resistance)(const BearingParameters& b);  // [ohm]
  double (*force_constant)(const BearingParameters& b);   // k of f = k c0 v [N/A²]
  /// Its own bias current [A]; nan: the controller's.
  double (*own_bias)(const BearingParameters& b);
  /// Direction (x, y) in which coil j pulls; along the axis of a bearing with one axis (±1, 0).
  std::array<double, 2> (*coil_direction)(const BearingParameters& b, int j);
  /// Of a bearing with one axis: the force that carries this weight [N]; nullptr: the radial
  /// bearings share the weight.
  double (*weight)(const BearingParameters& b, double mass, const std::array<double, 3>& gravity);

  void (*fill_lanes)(const BearingParameters& b, StatorLanes& lanes);
  PlaneMap (*plane)(const BearingParameters& b, const RotorModel& rotor, double z);
  /// The auxiliary bearing that stands at it; nullptr: this kind has none.
  void (*add_auxiliary)(const BearingParameters& b, RotorModel& rotor);
};

/// In the order of BearingKind.
std::span<const BearingKindTable* const> BearingKinds();
const BearingKindTable& TableOf(BearingKind kind);
/// "radial, thrust, opposed"
std::string BearingKindNames();

}  // namespace ambrig
