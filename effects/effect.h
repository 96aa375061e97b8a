#pragma once
/// What an effect is: optional physics that the base model does not have. One file per effect, one
/// line in effects/catalogue.cc. An effect attaches to seams of the plant (effects/plant.h); with
/// all its parameters at their null values it is not constructed at all, so the bits do not change.
#include <map>
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

/// Bits: the kinds of bearing at which an effect can act, as a target or behind one (a plane, an
/// axis, a coil).
enum ActsOn : unsigned {
  kOnRadial = 1,
  kOnThrust = 2,
  kOnOpposed = 4,
  kOnStator = 8,        // any stator with two axes
  kOnAxialStator = 16,  // any stator along the shaft
  kOnPoleByPole = 32,   // either of these whose coils have a pole each (PoleByPole)
  kOnAll = 63,
  // whose iron the lanes have coil by coil: laws of the iron act on these only
  kOnIron = kOnRadial | kOnThrust | kOnOpposed | kOnPoleByPole
};

/// What a run must have for the effect to show in its record.
struct EffectNeeds {
  bool rotation = false;      // a turning shaft
  bool levitation = false;    // a shaft that is free to move
  bool contact = false;       // a shaft on its auxiliary bearings
  bool free_speed = false;    // a speed that follows the moments
  bool freewheeling = false;  // bridges that let the current circulate through one diode
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
  // names above (and "z", the plane of a thrust bearing) -> what their bearing is, bits of ActsOn
  std::map<std::string, unsigned> kind;
};

/// An effect as a rig file names it.
struct EffectInstance {
  std::string name, target, label;
  std::vector<EffectParameter> table;  // copy of the description's, or the formula's own
  std::vector<double> values;          // one per row of the table
  std::vector<double> sd;              // 0 where unknown
  std::vector<std::pair<std::string, std::string>> formulas;  // formula effect: "force.x" -> text
  std::string where;                                          // file:line

  /// A law that its user wrote: its table stands in the rig file.
  bool IsFormula() const { return !formulas.empty(); }
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
  unsigned acts_on = kOnAll;
  EffectNeeds needs;
  bool users_own = false;      // law and parameters stand in the rig file: nothing can be proposed
  bool tone = false;           // one line of unknown frequency, not a resonance
  bool mains = false;          // that line is the mains' or a multiple
  bool adds_signal = false;    // to a reading, whatever the shaft does: no response shows it
  bool switches_pair = false;  // its two switches act together, with equal or opposite sign
  std::string
      positive;  // parameter that this physics never makes negative, though a fit may; empty: none
  // a switch whose null is infinite: the signature falls with this power of it
  double vanishing_order = 1;
  std::string whole_periods;  // parameter [s] that acts in whole switching periods; empty: none
  void (*apply)(const EffectInstance&, Plant&) = nullptr;
  // before planes exist: adds modes to the shaft
  void (*shape)(const EffectInstance&, Plant&) = nullptr;
};

/// "saturation at A"; the name alone where there is no target.
std::string NameAtTarget(const std::string& effect, const std::string& target);

/// All targets of this rig that the effect may have.
std::vector<std::string> TargetsOf(const EffectDescription& d, const EffectTargets& known);

/// Reads one [[effect]]; unknown names suggest the nearest. @throws InputError.
EffectInstance ReadEffect(const TomlTable& table, const EffectTargets& known);
EffectInstance MakeInstance(const EffectDescription& d, const std::string& target);

}  // namespace ambrig
