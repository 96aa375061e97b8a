#pragma once
/// What distinguishes the kinds of bearing, one file per kind beside this one: axes, keys
/// of the rig file, nominal figures, what is left of it after failures, and its parts of
/// the plant. Everything else asks this table what a bearing can do, not which one it is.
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "actuators/magnetics/stator_geometry.h"
#include "control/current/bias_linearisation.h"
#include "control/current/current_map.h"
#include "core/base/parameter_places.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

class RotorModel;
struct PlaneMap;

struct BearingKind {
  std::string_view name;  // as files write it
  unsigned acts_on;       // its bit of ActsOn

  // What it does to the shaft. One that neither acts along it nor holds a plane of it has one axis
  // across the shaft.
  bool axial = false;        // acts along the shaft; its plane is called "z"
  bool two_axes = false;     // holds the shaft in both directions of a plane, x and y
  bool eight_poles = false;  // by BearingParameters::radial; failed coils can be redistributed
  bool alone = false;        // the only bearing of a rotor of kind "point"

  int (*coils)(const BearingParameters& b);
  /// Names of the controlled axes.
  std::vector<std::string> (*axes)(const BearingParameters& b);
  /// Of a bearing with one axis: its direction (x, y, z).
  std::array<double, 3> (*axis)(const BearingParameters& b) = nullptr;

  /// The stator's keys.
  void (*read)(const TomlTable& t, BearingParameters& b, std::vector<Tolerance>* tolerances);
  void (*document)(std::vector<ParameterRow>& rows);
  /// Its numbers, by key.
  void (*numbers)(BearingParameters& b, const PlaceVisitor& visit);

  StatorGeometry (*stator)(const BearingParameters& b);
  double (*force_constant)(const BearingParameters& b);  // k of f = k c0 v [N/A²]
  /// Its own bias current [A]; nan: the controller's.
  double (*own_bias)(const BearingParameters& b);
  /// What must hold between it and the controller's bias current [A], and its bridges;
  /// may be empty.
  void (*check)(const TomlTable& t, const BearingParameters& b, double bias,
                bool unipolar) = nullptr;
  /// Of any stator: its healthy map, at this bias current [A] of the controller; nullptr:
  /// coil j takes [1, cos γ, sin γ].
  BiasLinearisation (*linearise)(const BearingParameters& b, double bias) = nullptr;
  /// Of a bearing without eight poles, unless it has `linearise`: changes the distribution matrix
  /// of `map` to what these shares of the coils' turns can do; says how much that is: "exact", "one
  /// way" or "none".
  std::string (*redistribute)(const BearingParameters& b, const CoilVector& turns_left,
                              CurrentMap& map) = nullptr;

  PlaneMap (*plane)(const BearingParameters& b, const RotorModel& rotor, double z);
  /// The auxiliary bearing that stands at it; nullptr: this kind has none.
  void (*add_auxiliary)(const BearingParameters& b, RotorModel& rotor) = nullptr;
};

std::span<const BearingKind* const> BearingKinds();
/// nullptr: no kind has this name.
const BearingKind* FindBearingKind(std::string_view name);
/// "radial, thrust, opposed"
std::string BearingKindNames();

/// Of kinds with an axis each that fail coil by coil: the rows of coils without turns become zero.
std::string DropLostCoils(const BearingParameters& b, const CoilVector& turns_left,
                          CurrentMap& map);

}  // namespace ambrig
