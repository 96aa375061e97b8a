// Effects of fits that are written down, behind those of the rig file.
#include "discovery/explain/adopted_effects.h"

#include <gtest/gtest.h>

#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

EffectInstance GainOf(const std::string& target, double gain) {
  EffectInstance e = MakeInstance(EffectNamed("sensor-gain"), target);
  e.Set("gain", gain);
  return e;
}

FitResult FitHolding(const std::vector<EffectInstance>& effects) {
  FitResult fit;
  for (const EffectInstance& e : effects) fit.hypothesis.AddEffect(e);
  fit.sd.assign(fit.hypothesis.free.size(), 0.01);
  return fit;
}

TEST(AdoptedEffects, StandBehindThoseOfTheRigFile) {
  AdoptedEffects adopted(1);
  adopted.AddLastOf(FitHolding({GainOf("B.x", 1.1), GainOf("A.x", 1.2)}));
  ASSERT_EQ(adopted.size(), 1u);
  EXPECT_EQ(adopted.PlaceOf(0), 1u);
  EXPECT_EQ(adopted[0].target, "A.x");
  EXPECT_DOUBLE_EQ(adopted[0].Value("gain"), 1.2);
  adopted.Renew(FitHolding({GainOf("B.x", 1.1), GainOf("A.y", 1.3)}));
  ASSERT_EQ(adopted.size(), 1u);
  EXPECT_EQ(adopted[0].target, "A.y");
}

TEST(AdoptedEffects, AreRemovedWithoutMovingTheOthers) {
  AdoptedEffects adopted(0);
  adopted.Take(FitHolding({GainOf("A.x", 1.1), GainOf("A.y", 1.2), GainOf("B.x", 1.3)}), 3);
  adopted.Remove(1);
  ASSERT_EQ(adopted.size(), 2u);
  EXPECT_EQ(adopted[0].target, "A.x");
  EXPECT_EQ(adopted[1].target, "B.x");
}

// The name counts, not the values, which later fits move.
TEST(AdoptedEffects, HowOneWasFoundHoldsForItsName) {
  AdoptedEffects adopted(0);
  EXPECT_FALSE(adopted.AnyOfOwnChannels());
  adopted.NoteOwnChannels(GainOf("A.x", 1.1));
  adopted.NoteBesideShape(GainOf("A.y", 1.1));
  EXPECT_TRUE(adopted.AnyOfOwnChannels());
  EXPECT_TRUE(adopted.IsOfOwnChannels(GainOf("A.x", 1.3)));
  EXPECT_FALSE(adopted.IsOfOwnChannels(GainOf("A.y", 1.1)));
  EXPECT_TRUE(adopted.IsBesideShape(GainOf("A.y", 0.9)));
  EXPECT_FALSE(adopted.IsBesideShape(GainOf("A.x", 1.1)));
}

TEST(AdoptedEffects, TheShapeOfOneLawMayExplainAll) {
  AdoptedEffects adopted(0);
  adopted.shaped = StageRatios{1.01, 1.02, 1.02, 1.03};
  EXPECT_FALSE(adopted.ShapeExplainsAll());  // nothing is adopted
  adopted.AddLastOf(FitHolding({GainOf("A.x", 1.1)}));
  EXPECT_TRUE(adopted.ShapeExplainsAll());
  adopted.shaped->validate = 1.2;
  EXPECT_FALSE(adopted.ShapeExplainsAll());
  adopted.shaped->validate = 1.02;
  adopted.AddLastOf(FitHolding({GainOf("A.x", 1.1), GainOf("A.y", 1.1)}));
  EXPECT_FALSE(adopted.ShapeExplainsAll());
}

// Saturation and reluctance of one iron are parts of one magnetisation curve; eddy currents are
// not.
TEST(AdoptedEffects, HoldTheMagnetisationOfTheirBearing) {
  const auto at = [](const char* effect, const char* target) {
    return MakeInstance(EffectNamed(effect), target);
  };
  AdoptedEffects adopted(0);
  adopted.AddLastOf(FitHolding({at("saturation", "B")}));
  EXPECT_TRUE(adopted.HoldMagnetisationOf(at("iron-reluctance", "B")));
  EXPECT_FALSE(adopted.HoldMagnetisationOf(at("iron-reluctance", "A")));
  EXPECT_FALSE(adopted.HoldMagnetisationOf(at("eddy-currents", "B")));
}

}  // namespace
}  // namespace ambrig
