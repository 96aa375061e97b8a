#pragma once
/// What is believed of a rig: its toleranced parameters and those of effects as free numbers.
#include <string>
#include <vector>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// A number that a fit may move: a toleranced rig parameter or a parameter of an effect.
struct FreeParameter {
  std::string path;     // "bearings.A.gap"; for effects "effect[k].name"
  int effect = -1;      // index of the effect, -1: rig parameter
  std::size_t row = 0;  // row of the effect's table
  double value = 0, start = 0;
  double sd = 0;  // prior (rig parameters); 0: none
  double lo = 0, hi = 0;
  double step = 0;  // natural size of a change, for differences and scaling
  bool logarithmic = false;
};

/// Whether both are the same effect at the same target, whatever its size.
inline bool IsSameName(const EffectInstance& a, const EffectInstance& b) {
  return a.name == b.name && a.target == b.target;
}

/// What is believed: the rig file's parameters and effects with values of the free ones.
struct Hypothesis {
  RigParameters rig;  // rig.effects holds the effects
  std::vector<FreeParameter> free;

  /// Toleranced parameters of the rig as free ones, with their prior; without one the parameters of
  /// formulas and those that an effect of the rig file gives with an sd.
  static Hypothesis Base(const RigParameters& rig);
  /// Adds an effect; its parameters become free.
  void AddEffect(const EffectInstance& effect);
  /// Whether it has an effect of this name at this target.
  bool Holds(const EffectInstance& effect) const;
  void Set(std::size_t parameter, double value);
  /// Internal coordinate of a parameter: offset over step, or log ratio; and back.
  double Coordinate(std::size_t parameter) const;
  /// The coordinate at which the parameter has this value.
  double CoordinateOf(std::size_t parameter, double value) const;
  double ValueAt(std::size_t parameter, double coordinate) const;
};

}  // namespace ambrig
