// Table-driven identities over every effect of the catalogue.
#include "effects/catalogue.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/effects/effect_rigs.h"

namespace ambrig {
void PrintTo(const EffectDescription& d, std::ostream* out) { *out << d.id; }

namespace {

/// The reference rig with an ADC so fine that a tiny change is not hidden by its steps.
RigParameters FineRig() {
  RigParameters rig = ReferenceRig();
  rig.amplifier.adc_bits = 24;
  return rig;
}

std::string FirstTarget(const EffectDescription& d, const RigParameters& rig) {
  return TargetsOf(d, TargetsOfEffects(rig)).at(0);
}

bool IsSwitch(const EffectDescription& d, const EffectParameter& p) {
  return std::find(d.off_when_null.begin(), d.off_when_null.end(), p.name) != d.off_when_null.end();
}

/// Every switch parameter a small part `eps` of its typical size away from null.
EffectInstance Tiny(const EffectDescription& d, const std::string& target, double eps) {
  EffectInstance e = MakeInstance(d, target);
  for (const EffectParameter& p : d.parameters) {
    if (!IsSwitch(d, p)) continue;
    const bool at_infinity = std::isinf(p.null_value);
    e.Set(p.name, at_infinity ? p.typical_hi / eps : p.null_value + eps * p.typical_lo);
  }
  return e;
}

class EveryEffect : public ::testing::TestWithParam<EffectDescription> {};

TEST_P(EveryEffect, IsDescribedCompletely) {
  const EffectDescription& d = GetParam();
  for (const std::string* text : {&d.id, &d.title, &d.physics, &d.shows_in, &d.confused_with})
    EXPECT_FALSE(text->empty());
  EXPECT_TRUE(d.apply != nullptr || d.shape != nullptr);
  if (d.id == "formula") return;  // its table stands in the rig file
  EXPECT_FALSE(d.parameters.empty());
  EXPECT_FALSE(d.off_when_null.empty());
  for (const std::string& name : d.off_when_null)
    EXPECT_TRUE(std::any_of(d.parameters.begin(), d.parameters.end(), [&](const auto& p) {
      return p.name == name;
    })) << name;
  for (const EffectParameter& p : d.parameters) {
    EXPECT_FALSE(p.name.empty() || p.unit.empty() || p.doc.empty()) << p.name;
    EXPECT_LE(p.lo, p.null_value) << p.name;
    EXPECT_GE(p.hi, p.null_value) << p.name;
    EXPECT_LT(p.typical_lo, p.typical_hi) << p.name;
    const double base = p.null_value == 1 && IsSwitch(d, p) ? 1 : 0;  // ratios: distance from 1
    EXPECT_LE(p.lo, base + p.typical_lo) << p.name;
    EXPECT_GE(p.hi, base + p.typical_hi) << p.name;
  }
}

TEST_P(EveryEffect, NullLeavesEveryBitOfTheRecord) {
  const EffectDescription& d = GetParam();
  if (d.id == "formula") GTEST_SKIP() << "has no parameters of its own";
  const RigParameters rig = ReferenceRig();
  static const Record base = RunText(rig, LevitatedText()).record;
  RigParameters with = rig;
  for (const std::string& target : TargetsOf(d, TargetsOfEffects(rig))) {
    with.effects.push_back(MakeInstance(d, target));
    EXPECT_TRUE(with.effects.back().IsNull());
  }
  const Record record = RunText(with, LevitatedText()).record;
  ASSERT_EQ(record.channels.size(), base.channels.size());
  for (const Channel& c : base.channels)
    EXPECT_EQ(c.samples, record.Find(c.name)->samples) << c.name;
}

// A run without contact, free speed and freewheeling bridges cannot show what needs them: nothing
// remains but what the fast and the general path differ by, 2e-7 of a channel.
TEST_P(EveryEffect, WhatARunLacksLeavesOnlyRounding) {
  const EffectDescription& d = GetParam();
  if (!d.needs.contact && !d.needs.free_speed && !d.needs.freewheeling)
    GTEST_SKIP() << "needs none of them";
  const RigParameters rig = FineRig();
  static const Record base = RunText(rig, LevitatedText()).record;
  RigParameters with = rig;
  with.effects.push_back(Tiny(d, FirstTarget(d, rig), 1));
  EXPECT_FALSE(with.effects.back().IsNull());
  EXPECT_LT(Change(base, RunText(with, LevitatedText()).record), 1e-6);
}

TEST(Effects, TargetsAreThoseWhoseBearingTheEffectCanActOn) {
  EffectTargets known;
  known.planes = {"A", "z", "M"};
  known.kind = {{"A", kOnRadial}, {"z", kOnThrust}, {"M", kOnOpposed}};
  EffectDescription d;
  d.target = TargetKind::kPlaneOrZ;
  EXPECT_EQ(TargetsOf(d, known), (std::vector<std::string>{"A", "z", "M"}));
  d.acts_on = kOnRadial;
  EXPECT_EQ(TargetsOf(d, known), (std::vector<std::string>{"A"}));
  d.acts_on = kOnThrust | kOnOpposed;
  EXPECT_EQ(TargetsOf(d, known), (std::vector<std::string>{"z", "M"}));
}

// Parameters 100 times nearer to null: the effect is 100 times smaller (the half-order law: 10
// times), down to what the fast and the general path differ by, 2e-7 of a channel.
TEST_P(EveryEffect, VanishesWithoutAJump) {
  const EffectDescription& d = GetParam();
  if (d.id == "formula") GTEST_SKIP() << "has no parameters of its own";
  if (d.id == "loop-delay")
    GTEST_SKIP() << "set-points wait for the next PWM start: whole periods only";
  const RigParameters rig = FineRig();
  static const Record base = RunText(rig, LevitatedText()).record;
  const auto change = [&](double eps) {
    RigParameters with = rig;
    with.effects.push_back(Tiny(d, FirstTarget(d, rig), eps));
    EXPECT_FALSE(with.effects.back().IsNull());
    return Change(base, RunText(with, LevitatedText()).record);
  };
  const double small = change(1e-2), smaller = change(1e-4);
  RecordProperty("small", std::to_string(small));
  RecordProperty("smaller", std::to_string(smaller));
  EXPECT_LE(smaller, std::max(0.12 * small, 1e-6));
  EXPECT_LT(smaller, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEffect, ::testing::ValuesIn(Catalogue()),
                         [](const auto& each) {
                           std::string name = each.param.id;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// A law takes turns and reluctances of the plant that others change: the file's order says nothing.
TEST(Catalogue, TheOrderOfEffectsChangesNothing) {
  const auto record = [](bool backwards) {
    RigParameters rig = ReferenceRig();
    rig = WithEffect(rig, "turn-mismatch", "A.coil1", {{"ratio", 1.4}});
    rig = WithEffect(rig, "hysteresis", "A", {{"coercive", 0.1}});
    rig = WithEffect(rig, "amplifier-offset", "A", {{"resistance", 0.1}});
    rig = WithEffect(rig, "iron-reluctance", "A", {{"path", 0.1}});
    if (backwards) std::ranges::reverse(rig.effects);
    return RunText(rig, LevitatedText()).record;
  };
  EXPECT_EQ(Change(record(false), record(true)), 0);
}

TEST(Catalogue, IdsAreUniqueAndFound) {
  std::set<std::string> ids;
  for (const EffectDescription& d : Catalogue()) {
    EXPECT_TRUE(ids.insert(d.id).second) << d.id;
    EXPECT_EQ(FindEffect(d.id), &d);
  }
  EXPECT_EQ(FindEffect("no-such-effect"), nullptr);
}

}  // namespace
}  // namespace ambrig
