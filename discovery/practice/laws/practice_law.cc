#include "discovery/practice/laws/practice_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"
#include "effects/catalogue.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

double PracticeDraw::Between(double lo, double hi) {
  return lo + (hi - lo) * Uniform(seed_, stream_, next_++);
}
double PracticeDraw::Log(double lo, double hi) { return lo * std::pow(hi / lo, Between(0, 1)); }
double PracticeDraw::Sign() { return Between(0, 1) < 0.5 ? -1 : 1; }
std::size_t PracticeDraw::Of(std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(Between(0, static_cast<double>(count))));
}

const std::vector<PracticeLaw>& PracticeLaws() {
  static const std::vector<PracticeLaw> all = [] {
    std::vector<PracticeLaw> out;
    for (const auto part : {IronLaws, DiffusionLaws, LoopLaws, PlaneForceLaws, TurningForceLaws,
                            ReadingLaws, ElectricLaws, StructureLaws, UnknownLaws, OwnLaws})
      for (PracticeLaw& law : part()) out.push_back(std::move(law));
    return out;
  }();
  return all;
}

std::vector<std::string> TargetsOfLaw(const PracticeLaw& law, const RigParameters& rig) {
  std::vector<std::string> out;
  for (const std::string& t : TargetsOf(EffectNamed(law.placed_as), TargetsOfEffects(rig))) {
    const std::string plane = t.substr(0, t.find('.'));
    if (t == "rig" ||
        std::any_of(rig.bearings.begin(), rig.bearings.end(), [&](const BearingParameters& b) {
          return b.name == plane && b.kind->two_axes;
        }))
      out.push_back(t);
  }
  return out;
}

EffectInstance FormulaAt(const std::string& target,
                         const std::vector<std::pair<std::string, std::string>>& formulas) {
  EffectInstance e = MakeInstance(EffectNamed("formula"), target);
  e.formulas = formulas;
  e.where = "practice law";
  return e;
}

EffectInstance CatalogueEffect(const std::string& id, const std::string& target,
                               const std::vector<std::pair<std::string, double>>& values) {
  EffectInstance e = MakeInstance(EffectNamed(id), target);
  for (const auto& [name, value] : values) {
    for (const EffectParameter& p : e.table)
      if (p.name == name) e.Set(name, std::clamp(value, p.lo, p.hi));
  }
  e.where = "practice law";
  return e;
}

std::string Digits(double value) { return fmt::format("({:.9g})", value); }

}  // namespace ambrig
