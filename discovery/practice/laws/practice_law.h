#pragma once
/// Laws of the plant for practice cases that are not the catalogue's: the same physics in another
/// form (other knees, orders of diffusion, asymmetries, dependence on speed or size), or physics
/// that the catalogue lacks. They are put together of effects that `explain` never proposes (tables
/// of the iron, relaxations, formulas), so that a true rig made of them is an ordinary rig file.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "effects/effect.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Numbers sampled one after the other; a copy draws the same ones again.
class PracticeDraw {
 public:
  PracticeDraw(std::uint64_t seed, std::uint32_t stream) : seed_(seed), stream_(stream) {}
  double Between(double lo, double hi);
  double Log(double lo, double hi);  // even in the logarithm
  double Sign();
  std::size_t Of(std::size_t count);  // 0 to count - 1

 private:
  std::uint64_t seed_;
  std::uint32_t stream_, next_ = 0;
};

struct LawSetting {
  const RigParameters& rig;
  std::string target;
  double size = 1;    // 1: usual; the law grows with it
  double weight = 0;  // of the rotor [N]
  double reach = 0;   // clearance at the target's plane [m]
  PracticeDraw draw;
};

struct PracticeLaw {
  std::string id, family;
  std::string effect;  // of the catalogue, that this is a form of; empty: none, "unknown" is right
  std::string
      placed_as;  // has the targets that this effect of the catalogue has on radial bearings
  std::function<std::vector<EffectInstance>(LawSetting)> make;
};

/// All of them, family by family. The parts of the list: one function per file.
const std::vector<PracticeLaw>& PracticeLaws();
std::vector<PracticeLaw> IronLaws();
std::vector<PracticeLaw> DiffusionLaws();
std::vector<PracticeLaw> LoopLaws();
std::vector<PracticeLaw> PlaneForceLaws();
std::vector<PracticeLaw> TurningForceLaws();
std::vector<PracticeLaw> ReadingLaws();
std::vector<PracticeLaw> ElectricLaws();
std::vector<PracticeLaw> StructureLaws();
std::vector<PracticeLaw> UnknownLaws();
/// The catalogue's own laws with random sizes, for effects that have no other form here.
std::vector<PracticeLaw> OwnLaws();

/// Targets that this rig offers: "rig", radial bearings, their axes and coils.
std::vector<std::string> TargetsOfLaw(const PracticeLaw& law, const RigParameters& rig);

/// A formula of these quantities ("force.x", "reading.y", "voltage" ...) at the target.
EffectInstance FormulaAt(const std::string& target,
                         const std::vector<std::pair<std::string, std::string>>& formulas);
/// An effect of the catalogue with these parameters, the others at their nulls.
EffectInstance CatalogueEffect(const std::string& id, const std::string& target,
                               const std::vector<std::pair<std::string, double>>& values);
/// A number in a formula, in brackets.
std::string Digits(double value);

}  // namespace ambrig
