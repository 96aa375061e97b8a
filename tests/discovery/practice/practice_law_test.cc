// Laws of other forms: they build on every rig, are drawn the same again, grow with their size and
// are not what explain proposes.
#include "discovery/practice/laws/practice_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "discovery/practice/practice_case.h"
#include "effects/catalogue.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

RigParameters ExampleRig(const std::string& name) {
  return ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/" + name + "/rig.toml");
}

LawSetting SettingOf(const RigParameters& rig, const std::string& target, double size) {
  return {rig, target, size, rig.rotor.mass * 9.81, 2e-4, PracticeDraw(3, 7)};
}

/// Numbers and texts of all effects.
std::string TextOf(const std::vector<EffectInstance>& effects) {
  std::string text;
  for (const EffectInstance& e : effects) {
    text += e.name + "@" + e.target;
    for (const double v : e.values) text += " " + Digits(v);
    for (const auto& [quantity, formula] : e.formulas) text += " " + quantity + "=" + formula;
  }
  return text;
}

class EveryPracticeLaw : public ::testing::TestWithParam<std::string> {
 protected:
  const PracticeLaw& law() const {
    for (const PracticeLaw& l : PracticeLaws())
      if (l.id == GetParam()) return l;
    throw std::logic_error(GetParam());
  }
};

TEST_P(EveryPracticeLaw, BuildsOnEveryExampleAtEveryTarget) {
  int built = 0;
  for (const char* name : {"reference", "small_spindle", "heavy_compressor"}) {
    const RigParameters rig = ExampleRig(name);
    for (const std::string& target : TargetsOfLaw(law(), rig)) {
      RigParameters with = rig;
      with.effects = law().make(SettingOf(rig, target, 1));
      ASSERT_FALSE(with.effects.empty());
      EXPECT_NO_THROW(BuildPlant(TrueRig(with))) << name << " " << target;
      ++built;
    }
  }
  // freewheel-drop needs amplifiers that none of these rigs has, but its targets are coils
  EXPECT_GT(built, 0);
}

TEST_P(EveryPracticeLaw, SameDrawSameLawAndAnotherSizeAnotherLaw) {
  const RigParameters rig = ExampleRig("reference");
  const std::string target = TargetsOfLaw(law(), rig).at(0);
  const std::string usual = TextOf(law().make(SettingOf(rig, target, 1)));
  EXPECT_EQ(usual, TextOf(law().make(SettingOf(rig, target, 1))));
  EXPECT_NE(usual, TextOf(law().make(SettingOf(rig, target, 1.9))));
}

TEST_P(EveryPracticeLaw, CountsAsAnEffectThatExplainProposes) {
  if (law().effect.empty()) {
    EXPECT_EQ(law().placed_as, "cross-coupling");
  } else {
    EXPECT_FALSE(EffectNamed(law().effect).users_own);
  }
  EXPECT_FALSE(law().family.empty());
}

std::vector<std::string> LawNames() {
  std::vector<std::string> out;
  for (const PracticeLaw& l : PracticeLaws()) out.push_back(l.id);
  return out;
}

INSTANTIATE_TEST_SUITE_P(Practice, EveryPracticeLaw, ::testing::ValuesIn(LawNames()),
                         [](const auto& of) {
                           std::string name = of.param;
                           for (char& ch : name)
                             if (ch == '-') ch = '_';
                           return name;
                         });

TEST(PracticeLawList, NamesAreUniqueAndFamiliesAreSplit) {
  std::set<std::string> names, fitted, checked;
  for (const PracticeLaw& l : PracticeLaws()) {
    EXPECT_TRUE(names.insert(l.id).second) << l.id;
    (FamilyIsForFit(l.family) ? fitted : checked).insert(l.family);
  }
  EXPECT_GT(fitted.size(), 10U);
  EXPECT_GT(checked.size(), 10U);
}

// Rayleigh's iron: path = size 3e-5/(1 + a B)^2 falls from its first node on; a power rises.
TEST(PracticeLawForms, IronRisesAndFalls) {
  const RigParameters rig = ExampleRig("reference");
  for (const PracticeLaw& l : PracticeLaws()) {
    if (l.id != "reluctance-rayleigh" && l.id != "saturation-power") continue;
    const EffectInstance e = l.make(SettingOf(rig, "A", 1)).at(0);
    const double first = e.Value("path1"), last = e.Value("path9");
    if (l.id == "saturation-power") {
      EXPECT_GT(last, 10 * first);
    } else {
      EXPECT_LT(last, first);
      EXPECT_NEAR(e.Value("path0"), 3e-5, 1e-12);
    }
  }
}

// The relaxations of order a sum to sin(a pi)/pi Σ (p/w)^a Δ ln p: from one to the next they grow
// by 10^(a/2).
TEST(PracticeLawForms, RelaxationsFollowTheirOrder) {
  const RigParameters rig = ExampleRig("reference");
  for (const PracticeLaw& l : PracticeLaws()) {
    if (l.id != "eddy-order") continue;
    const EffectInstance e = l.make(SettingOf(rig, "A", 1)).at(0);
    const double order = 2 * std::log10(e.Value("r6") / e.Value("r5"));
    EXPECT_NEAR(2 * std::log10(e.Value("r9") / e.Value("r8")), order, 1e-6);
    EXPECT_GT(std::abs(order - 0.5), 0.06) << "another order than the catalogue's";
  }
}

// Dampings between 0.003 and 0.02, even in the logarithm: of 300 draws the ends are within a
// fiftieth of the decades.
TEST(PracticeLawForms, DampingsOfTwoModesFillTheirRange) {
  const RigParameters rig = ExampleRig("reference");
  double least = 1, most = 0;
  for (const PracticeLaw& l : PracticeLaws()) {
    if (l.id != "bending-two-modes") continue;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      LawSetting s = SettingOf(rig, "rig", 1);
      s.draw = PracticeDraw(seed, 7);
      const double damping = l.make(s).at(0).Value("damping");
      least = std::min(least, damping);
      most = std::max(most, damping);
    }
  }
  EXPECT_GE(least, 0.003);
  EXPECT_LT(least, 0.0033);
  EXPECT_LE(most, 0.02);
  EXPECT_GT(most, 0.018);
}

// Messages about an effect say where it was written: these stand in no file.
TEST(PracticeLaw, EveryEffectSaysThatALawOfPracticeMadeIt) {
  const RigParameters rig = ExampleRig("reference");
  for (const PracticeLaw& law : PracticeLaws()) {
    const std::vector<std::string> targets = TargetsOfLaw(law, rig);
    if (targets.empty()) continue;
    for (const EffectInstance& e : law.make(SettingOf(rig, targets[0], 1)))
      EXPECT_EQ(e.where, "practice law") << law.id;
  }
}

}  // namespace
}  // namespace ambrig
