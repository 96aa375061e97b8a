#include "discovery/shape/shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/errors.h"
#include "effects/catalogue.h"

namespace ambrig {

namespace {

constexpr std::array<const char*, 4> kIron = {"saturation", "iron-reluctance", "eddy-currents",
                                              "hysteresis"};
constexpr std::array<const char*, 3> kMagnetisation = {"saturation", "iron-reluctance", "bh-curve"};
constexpr std::array<const char*, 4> kMotion = {"side-pull", "cross-coupling", "windage",
                                                "coupling-misalignment"};
constexpr const char* kReading = "sensor-gain";

template <class Names>
bool Holds(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<double> Shape::Sizes() const {
  std::vector<double> out;
  for (const std::size_t row : rows) out.push_back(effect.values[row]);
  return out;
}

std::string RefinableEffects() {
  std::string all;
  for (const char* name : kIron) all += (all.empty() ? "" : ", ") + std::string(name);
  for (const char* name : kMotion) all += ", " + std::string(name);
  return all + ", " + kReading;
}

bool IsRefinable(const std::string& effect) {
  return IsIronLaw(effect) || IsMotionLaw(effect) || effect == kReading;
}

bool IsIronLaw(const std::string& effect) { return Holds(kIron, effect); }

bool ShareMagnetisation(const std::string& a, const std::string& b) {
  return Holds(kMagnetisation, a) && Holds(kMagnetisation, b);
}

bool IsMotionLaw(const std::string& effect) { return Holds(kMotion, effect); }

bool DependsOnFlux(const std::string& effect) {
  return IsIronLaw(effect) && effect != "eddy-currents";
}

Shape ShapeOf(const EffectInstance& named, const RigParameters& rig, const ShapeReach& reach) {
  if (IsIronLaw(named.name)) return IronShape(named, rig, reach);
  if (named.name == "coupling-misalignment") return TurningShape(named);
  if (named.name == kReading) return ReadingShape(named, reach);
  if (IsMotionLaw(named.name)) return MotionShape(named, reach);
  throw InputError(
      fmt::format("{} has no curve to refine, allowed: {}", named.name, RefinableEffects()));
}

std::vector<double> CurvePlaces(double hi) {
  std::vector<double> u;
  for (int k = 0; k < kCurvePoints; ++k) u.push_back(hi * k / (kCurvePoints - 1));
  return u;
}

Shape FormulaShape(const EffectInstance& named, const std::string& target) {
  Shape s;
  s.effect = MakeInstance(EffectNamed("formula"), target);
  s.effect.label = named.name + ", refined";
  return s;
}

void AddFormulaSize(Shape& shape, const EffectParameter& size, double start) {
  shape.rows.push_back(shape.effect.table.size());
  shape.effect.table.push_back(size);
  shape.effect.values.push_back(start);
  shape.effect.sd.push_back(0);
}

Eigen::MatrixXd Differences(Eigen::Index n, int order) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Identity(n, n);
  for (int k = 0; k < order; ++k) D = (D.bottomRows(D.rows() - 1) - D.topRows(D.rows() - 1)).eval();
  return D;
}

}  // namespace ambrig
