#pragma once
/// What an effect is: optional physics that the base model does not have. One file per effect, one
/// line in effects/catalogue.cc. An effect attaches to seams of the plant (effects/plant.h); with
/// all its parameters at their null values it is not constructed at all, so the bits do not change.
#include <string>
#include <vector>

#include "core/base/toml.h"

namespace ambrig {

struct Plant;

enum class TargetKind {
  kRig,
  kBearing,
  kPlane,
  kPlaneOrZ,
  kPlaneOrRig,
  kCoil,
  kCoilOrBearing,
  kAxis,
  kAny
};

/// One parameter of an effect: physical bounds, null value, and where it is usually found.
struct EffectParameter {
  std::string name, unit;
  double null_value = 0;
  double lo = -kInfinity, hi = kInfinity;  // possible
  double typical_lo = 0, typical_hi = 0;   // usual size; of a switch its distance from null
  std::string doc;
  // false: a formula's parameter that never switches it off
  bool has_null = true;
};

/// Names that a rig offers as targets.
struct EffectTargets {
  std::vector<std::string> bearings, planes, coils, axes;
  std::vector<std::string> stations;  // named planes of a beam rotor
};

/// An effect as a rig file names it.
struct EffectInstance {
  std::string name, target, label;
  std::vector<EffectParameter> table;  // copy of the description's, or the formula's own
  std::vector<double> values;          // one per row of the table
  std::vector<double> sd;              // 0 where unknown
  std::vector<std::pair<std::string, std::string>> formulas;  // formula effect: "force.x" -> text
  std::string where;                                          // file:line

  double Value(const std::string& parameter) const;
  void Set(const std::string& parameter, double value);
  /// Every parameter at its null value: nothing is built. Parameters that say where or how (a
  /// frequency, a time constant) do not count when a null of another one already switches it off.
  bool IsNull() const;
};

struct EffectDescription {
  std::string id, title, physics;
  TargetKind target;
  std::vector<EffectParameter> parameters;
  // the parameters whose null switches the effect off (any of... all of these null)
  std::vector<std::string> off_when_null;
  /// Whether this parameter's null takes part in switching the effect off.
  bool Switches(const EffectParameter& p) const;
  std::string shows_in;  // which record shows it
  std::string confused_with;
  bool at_stations = false;  // a plane may also be a disk or station of a beam rotor
  void (*apply)(const EffectInstance&, Plant&) = nullptr;
  // before planes exist: adds modes to the shaft
  void (*shape)(const EffectInstance&, Plant&) = nullptr;
};

/// All targets of this rig that the effect may have.
std::vector<std::string> TargetsOf(const EffectDescription& d, const EffectTargets& known);

/// Reads one [[effect]]; unknown names suggest the nearest. @throws InputError.
EffectInstance ReadEffect(const TomlTable& table, const EffectTargets& known);
EffectInstance MakeInstance(const EffectDescription& d, const std::string& target);

}  // namespace ambrig
