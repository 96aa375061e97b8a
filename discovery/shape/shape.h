#pragma once
/// The law of a named effect in a free shape: a sum whose sizes are fitted, smooth unless the
/// records say otherwise. Each shape is an effect that the engines run (bh-curve, eddy-impedance,
/// play-hysteresis, or a formula made of ramps), starting where the catalogue's law was fitted.
#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "effects/effect.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

struct Shape {
  EffectInstance effect;          // at its start
  std::vector<std::size_t> rows;  // of its table: the sizes that are fitted
  Eigen::VectorXd step;           // natural step of each size, its unit
  Eigen::MatrixXd roughness;      // rows of differences of the sizes (in steps) that are penalised
  std::vector<double> knots;  // u where each size acts; NaN: it belongs to no place of the curve
  bool everywhere = false;    // every size acts at every u: no knots
  std::string u_name, u_unit, value_name, value_unit;
  std::vector<double> u;  // where the curve is given
  bool logarithmic = false;
  /// Value of the curve at u for the sizes given (their own units).
  std::function<double(const std::vector<double>& sizes, double u)> value;

  std::vector<double> Sizes() const;
};

/// How far the records drive what the law depends on.
struct ShapeReach {
  double density = 0;  // largest flux density of the bearing's poles [T]
  double radius = 0;   // largest displacement of the plane, or along the axis [m]
  double speed = 0;    // largest speed [rad/s]
};

/// Effects of the catalogue whose law can be refined, "eddy-currents, saturation, ...".
std::string RefinableEffects();
bool IsRefinable(const std::string& effect);
/// Whether the effect is a law of the iron.
bool IsIronLaw(const std::string& effect);
/// Whether both are laws of the magnetisation curve: the free shape of one holds what the other
/// adds.
bool ShareMagnetisation(const std::string& a, const std::string& b);
/// The part of the iron's MMF at the end of a magnetisation curve that is made by a rise of the
/// incremental path [m] with the flux (nodes at equal distances from zero flux): 0 where the path
/// is constant or falls, as that of reluctance does; 1 where the iron needs nothing at low flux, as
/// below a knee.
double SaturatingShare(const std::vector<double>& path);
/// Whether the effect is a force or a drag that depends on the motion or on the angle of the shaft.
bool IsMotionLaw(const std::string& effect);
/// Whether the shape depends on the flux density of a bearing.
bool DependsOnFlux(const std::string& effect);

/// The shape that replaces `named`, a fitted effect of the catalogue. @throws InputError when the
/// effect has none, or the records do not move it.
Shape ShapeOf(const EffectInstance& named, const RigParameters& rig, const ShapeReach& reach);

inline constexpr int kCurvePoints = 61;
/// So many places from 0 to `hi`.
std::vector<double> CurvePlaces(double hi);

/// A shape that is a `formula` of the rig file at `target`, without sizes yet.
Shape FormulaShape(const EffectInstance& named, const std::string& target);
/// One more size of such a shape, where it starts.
void AddFormulaSize(Shape& shape, const EffectParameter& size, double start);

/// Second differences of n neighbours (or first ones).
Eigen::MatrixXd Differences(Eigen::Index n, int order);

// of iron_shapes.cc, motion_shapes.cc, turning_shapes.cc and reading_shapes.cc
Shape IronShape(const EffectInstance& named, const RigParameters& rig, const ShapeReach& reach);
Shape MotionShape(const EffectInstance& named, const ShapeReach& reach);
Shape TurningShape(const EffectInstance& named);
Shape ReadingShape(const EffectInstance& named, const ShapeReach& reach);

}  // namespace ambrig
