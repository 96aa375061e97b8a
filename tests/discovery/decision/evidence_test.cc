// Names, sizes, drift and verdicts: the rules alone, on numbers that are known.
#include "discovery/decision/evidence.h"

#include <gtest/gtest.h>

#include "discovery/decision/decide.h"
#include "discovery/decision/drift_test.h"
#include "effects/catalogue.h"

namespace ambrig {
namespace {

EffectInstance Gain(double value, double sd) {
  EffectInstance e = MakeInstance(EffectNamed("sensor-gain"), "A.x");
  e.Set("gain", value);
  e.sd.assign(e.values.size(), sd);
  return e;
}

TEST(HasSize, NeedsThreeOfItsOwnSd) {
  EXPECT_TRUE(HasSize(Gain(1.04, 0.01)));
  EXPECT_FALSE(HasSize(Gain(1.02, 0.01)));
  EXPECT_TRUE(HasSize(Gain(1.02, 0)));  // its sd is not known
  EXPECT_FALSE(HasSize(Gain(1.0, 0)));
}

// A size that does not show, beside sizes that the records tell: only what is told says whether the
// effect is there.
TEST(HasSize, SizesThatDoNotShowSayNothingBesideOthers) {
  EffectInstance e = MakeInstance(EffectNamed("amplifier-offset"), "B");
  e.Set("offset", 0.07);
  e.Set("dead_duty", 4e-5);
  e.sd.assign(e.values.size(), 0.0);
  EXPECT_TRUE(HasSize(e));
  e.sd[0] = 1.2;  // of the offset
  EXPECT_FALSE(HasSize(e));
  e.Set("dead_duty", 0.05);  // as large as usual
  EXPECT_TRUE(HasSize(e));
}

// A gain that differs between the two directions leaves a constant when one gain is fitted.
TEST(IsDetailOf, TheSameSensorAndLessThanHalfOfAUsualSize) {
  EffectInstance offset = MakeInstance(EffectNamed("sensor-offset"), "A.y");
  offset.Set("offset", 4e-7);  // usual: 2e-6 and more
  const std::vector<EffectInstance> gain = {MakeInstance(EffectNamed("sensor-gain"), "A.y")};
  EXPECT_TRUE(IsDetailOf(gain, offset));
  EXPECT_FALSE(IsDetailOf({}, offset));
  EXPECT_FALSE(IsDetailOf({MakeInstance(EffectNamed("sensor-gain"), "A.x")}, offset));
  offset.Set("offset", -1.2e-6);
  EXPECT_FALSE(IsDetailOf(gain, offset));
}

// Effects of a whole bearing may be weak beside a strong one.
TEST(IsDetailOf, OnlyOfCoilsAndSensors) {
  EffectInstance weak = MakeInstance(EffectNamed("fringing"), "A");
  weak.Set("coefficient", 1e-6);
  EXPECT_FALSE(IsDetailOf({MakeInstance(EffectNamed("saturation"), "A")}, weak));
}

// Both sizes are within their sd of nothing.
TEST(HasSize, AnOffsetWithinItsSdIsNothing) {
  EffectInstance e = MakeInstance(EffectNamed("amplifier-offset"), "B");
  e.Set("offset", -0.000694);
  e.Set("dead_duty", 0.02802);
  e.sd = {0.00097, 0.038};
  EXPECT_FALSE(HasSize(e));
  e.sd = {0.0002, 0.038};  // one size that is seen is enough
  EXPECT_TRUE(HasSize(e));
}

TEST(HasSize, ANullOfInfinityIsAwayWhenTheInverseIs) {
  EffectInstance e = MakeInstance(EffectNamed("eddy-currents"), "A");
  e.Set("cutoff", 3000);
  e.sd.assign(e.values.size(), 500.0);
  EXPECT_TRUE(HasSize(e));
  e.sd.assign(e.values.size(), 2000.0);
  EXPECT_FALSE(HasSize(e));
}

// A slow rise tells the quotient of size and time constant: each alone is unknown, and yet
// something is there.
TEST(HasSize, ASizeThatGoesWithATimeConstantIsJudgedWithThatHeld) {
  EffectInstance e = MakeInstance(EffectNamed("copper-heating"), "B");
  e.Set("rise_per_watt", 200);
  e.Set("time_constant", 5);
  FitResult fit;
  fit.hypothesis.rig.effects.clear();
  fit.hypothesis.AddEffect(e);
  ASSERT_EQ(fit.hypothesis.free.size(), 3U);
  fit.sd = {700, 18, 0.1};
  fit.size_sd = {3, 0, 0};
  EXPECT_FALSE(HasSize(FittedEffect(fit, 0)));
  EXPECT_TRUE(HasSize(fit, 0));
  fit.doubt = {40, 1, 1};
  EXPECT_TRUE(HasSize(fit, 0));
  EXPECT_FALSE(HasSizeUnderDoubt(fit, 0));
  fit.size_sd = {150, 0, 0};
  EXPECT_FALSE(HasSize(fit, 0));
}

// Beside a law that may be another one, a single size needs two sd. The largest of the fourteen of
// a run-out exceeds that by chance every second time.
TEST(HasSize, TheLargestOfManySizesIsFartherFromNothing) {
  for (const auto& [distance, seen] : {std::pair{2.5, false}, {3.1, true}}) {
    EffectInstance e = MakeInstance(EffectNamed("sensor-runout"), "A");
    e.Set("c2", distance * 1e-7);
    for (const char* size : {"s2", "c4", "s4"}) e.Set(size, 1e-7);
    FitResult fit;
    fit.hypothesis.rig.effects.clear();
    fit.hypothesis.AddEffect(e);
    fit.sd.assign(fit.hypothesis.free.size(), 1e-7);
    fit.size_sd = fit.sd;
    for (FreeParameter& p : fit.hypothesis.free)  // every size differs from nothing by something
      if (p.value == 0) fit.hypothesis.Set(&p - fit.hypothesis.free.data(), 1e-9);
    EXPECT_EQ(HasSizeUnderDoubt(fit, 0), seen) << distance;
  }
  EffectInstance one = Gain(1.025, 0.01);
  FitResult fit;
  fit.hypothesis.rig.effects.clear();
  fit.hypothesis.AddEffect(one);
  fit.sd = fit.size_sd = {0.01};
  EXPECT_TRUE(HasSizeUnderDoubt(fit, 0));
}

TEST(CredibleSet, HoldsUnknownBesideTheNames) {
  std::vector<RankedEffect> ranking(2);
  ranking[0].effect = Gain(1.1, 0.01);
  ranking[1].effect = MakeInstance(EffectNamed("sensor-offset"), "A.x");
  ranking[0].probability = 0.9;
  ranking[1].probability = 0.1;
  const auto set = CredibleSet(ranking, 0.6);
  ASSERT_EQ(set.size(), 3U);
  EXPECT_EQ(set[0].effect, "sensor-gain");
  EXPECT_NEAR(set[0].probability, 0.54, 1e-12);
  EXPECT_EQ(set[1].effect, "unknown");
  EXPECT_NEAR(set[1].probability, 0.4, 1e-12);
  EXPECT_NEAR(ranking[1].probability, 0.06, 1e-12);
  std::vector<RankedEffect> sure(1);
  sure[0].effect = Gain(1.1, 0.01);
  sure[0].probability = 1;
  EXPECT_EQ(CredibleSet(sure, 0.99).size(), 1U);
}

TEST(NameProbability, RisesWithTheShareExplained) {
  EXPECT_LT(NameProbability(0.2, 5), 0.1);
  EXPECT_GT(NameProbability(0.7, 1.6), 0.9);
  EXPECT_GT(NameProbability(0.6, 1.0), NameProbability(0.6, 2.0));
}

TEST(DriftTest, ConstantHoldsAndDriftingDoesNot) {
  const std::vector<double> weight(8, 25.0);  // sd 0.2 each
  EXPECT_TRUE(TestDrift({1.1, 0.9, 1.2, 0.8, 1.0, 1.05, 0.95, 1.0}, weight).holds);
  const DriftTest drifts = TestDrift({3, 0, -2, 1, 4, -3, 2, 0}, weight);
  EXPECT_FALSE(drifts.holds);
  EXPECT_EQ(drifts.freedom, 7);
  // Records that do not see it have no say.
  EXPECT_TRUE(TestDrift({1.0, 1.1, 99}, {25, 25, 1e-9}).holds);
  // (4 (1 - 1.5)^2 + 4 (2 - 1.5)^2) = 2
  EXPECT_DOUBLE_EQ(TestDrift({1, 2}, {4, 4}).q, 2);
}

TEST(Verdict, EveryRecordCountsAndFiveSdAreNoParameter) {
  const StageRatios clean = {1.0, 1.01, 1.02}, wrong = {9.5, 1.0, 40}, mid = {4, 4, 6};
  const ParameterNeed fine, far = {5.5, true, true}, drifting = {3.5, true, false};
  EXPECT_EQ(VerdictOf(clean, clean, fine, FoundEffect::kNone), ExplanationVerdict::kNone);
  // a FIT record at 9.5 floors is not nothing
  EXPECT_EQ(VerdictOf(wrong, wrong, fine, FoundEffect::kNone), ExplanationVerdict::kUnknown);
  EXPECT_EQ(VerdictOf(mid, clean, fine, FoundEffect::kNone), ExplanationVerdict::kParameters);
  EXPECT_EQ(VerdictOf(mid, clean, far, FoundEffect::kNone), ExplanationVerdict::kUnknown);
  EXPECT_EQ(VerdictOf(mid, clean, drifting, FoundEffect::kNone), ExplanationVerdict::kUnknown);
  EXPECT_EQ(VerdictOf(mid, clean, {3.5, true, true}, FoundEffect::kNone),
            ExplanationVerdict::kParameters);
  EXPECT_EQ(VerdictOf(mid, mid, fine, FoundEffect::kEstablished), ExplanationVerdict::kEffect);
}

}  // namespace
}  // namespace ambrig
