// When an effect is believed: shares of the error, limits of parameters, the rule of adoption.
#include "discovery/decision/decide.h"

#include <gtest/gtest.h>

#include <cmath>

#include <algorithm>
#include <vector>

namespace ambrig {
namespace {

TEST(ExplainedShare, IsOfTheSquaredErrorAboveTheFloor) {
  EXPECT_DOUBLE_EQ(ExplainedShare(3, 2), 5.0 / 8);  // of 9 - 1 the step takes 9 - 4
  EXPECT_DOUBLE_EQ(ExplainedShare(3, 1), 1);
  EXPECT_DOUBLE_EQ(ExplainedShare(3, 0.5), 1);  // below the floor nothing is left to explain
  EXPECT_DOUBLE_EQ(ExplainedShare(3, 4), 0);    // worse than before
  EXPECT_DOUBLE_EQ(ExplainedShare(1, 0.9), 0);  // nothing stood above the floor
}

// What two steps leave is the product of what each leaves.
TEST(ExplainedShare, StepsMultiply) {
  for (const double a : {20.0, 3.0, 1.4})
    for (const double b : {1.3, 1.2, 1.1})
      for (const double c : {1.09, 1.02})
        EXPECT_NEAR(1 - ExplainedShare(a, c),
                    (1 - ExplainedShare(a, b)) * (1 - ExplainedShare(b, c)), 1e-12);
}

/// A fit with `priors` rig parameters, their squared shifts over sd summing to `penalty`, and one
/// parameter of an effect.
FitResult FitWith(double ratio_fit, double ratio_validate, int priors = 4, double penalty = 0) {
  FitResult f;
  f.ratio_fit = ratio_fit;
  f.ratio_validate = ratio_validate;
  f.penalty = penalty;
  f.converged = true;
  FreeParameter p;
  p.sd = 1;
  f.hypothesis.free.assign(static_cast<std::size_t>(priors), p);
  p.sd = 0;
  f.hypothesis.free.push_back(p);
  return f;
}

TEST(Believable, CountsOnlyParametersWithAPrior) {
  EXPECT_TRUE(Believable(FitWith(1, 1, 4, 8.7)));
  EXPECT_FALSE(Believable(FitWith(1, 1, 4, 8.9)));
  EXPECT_FALSE(Believable(FitWith(1, 1, 3, 8.7)));
  EXPECT_TRUE(Believable(FitWith(1, 1, 0, 0)));
}

TEST(WorthAdopting, NeedsAConvergedFitAndAGain) {
  FitResult after = FitWith(1, 1);
  EXPECT_TRUE(WorthAdopting(FitWith(3, 3), after, 100, 0, 0));
  EXPECT_FALSE(WorthAdopting(FitWith(3, 3), after, 19, 0, 0));
  after.converged = false;
  EXPECT_FALSE(WorthAdopting(FitWith(3, 3), after, 100, 0, 0));
}

TEST(WorthAdopting, UnseenRecordsDecide) {
  // Half of the squared error of the fitted records is gone, the unseen ones saw nothing of it.
  EXPECT_FALSE(WorthAdopting(FitWith(3, 3), FitWith(2, 3), 100, 0, 0));
  // A quarter of what is left on unseen records is asked of the first effect.
  EXPECT_FALSE(WorthAdopting(FitWith(3, 3), FitWith(3, 2.7), 100, 0, 0));
  EXPECT_TRUE(WorthAdopting(FitWith(3, 3), FitWith(3, 2.5), 100, 0, 0));
  // All of the excess, but as little as integrators differ.
  EXPECT_FALSE(WorthAdopting(FitWith(1.006, 1.006), FitWith(1, 1), 100, 0, 0));
}

TEST(WorthAdopting, WhatOnlyTheFitRecordsShowMustBePlainAndDoNoHarm) {
  EXPECT_TRUE(WorthAdopting(FitWith(9, 1.2), FitWith(2, 1.2), 300, 0, 0));
  EXPECT_FALSE(WorthAdopting(FitWith(9, 1.2), FitWith(8, 1.2), 300, 0, 0));     // not plain
  EXPECT_FALSE(WorthAdopting(FitWith(9, 1.2), FitWith(2, 1.25), 300, 0, 0));    // harm
  EXPECT_FALSE(WorthAdopting(FitWith(9, 1.2), FitWith(2, 1.2), 300, 1, 0.01));  // as a second one
}

TEST(WorthAdopting, ASecondEffectIsNoDetailOfTheFirst) {
  const FitResult before = FitWith(2, 2), half = FitWith(1.5, 1.5), most = FitWith(1.2, 1.2);
  ASSERT_NEAR(ExplainedShare(2, 1.5), 0.583, 1e-3);
  // The first brought the square down by 400: 1.75 more is its own detail.
  EXPECT_FALSE(WorthAdopting(before, half, 100, 1, 400));
  EXPECT_TRUE(WorthAdopting(before, half, 100, 1, 10));   // it weighs against the first
  EXPECT_TRUE(WorthAdopting(before, half, 250, 1, 400));  // compelling in the likelihood
  EXPECT_TRUE(WorthAdopting(before, most, 100, 1, 400));  // explains most of what is left
}

// 1.03 -> 1.005 explains most of what is left, but no more than the detail of a first law that won
// 5.
TEST(WorthAdopting, ASecondEffectWinsMoreThanTheFirstLawsDetail) {
  const FitResult before = FitWith(1.03, 1.03), after = FitWith(1.005, 1.005);
  EXPECT_FALSE(WorthAdopting(before, after, 100, 1, 5));
  EXPECT_TRUE(WorthAdopting(before, after, 100, 1, 1));
  // at most a tenth of the noise's power is a law's detail, however strong the effect
  EXPECT_TRUE(WorthAdopting(FitWith(1.06, 1.06), FitWith(1, 1), 100, 1, 1000));
}

TEST(WorthAdopting, BringsParametersBackToWhereTheyMayBe) {
  const FitResult strained = FitWith(1.5, 1.5, 4, 40), relaxed = FitWith(1.5, 1.5, 4, 2);
  EXPECT_TRUE(WorthAdopting(strained, relaxed, 30, 0, 0));
  EXPECT_TRUE(WorthAdopting(strained, relaxed, 30, 2, 100));
  EXPECT_FALSE(WorthAdopting(strained, FitWith(1.5, 1.53, 4, 2), 30, 0, 0));  // at a price
  EXPECT_FALSE(WorthAdopting(strained, FitWith(1.5, 1.5, 4, 30), 30, 0, 0));  // still strained
}

// A better fit of the unseen records, or a larger gain, never turns a yes into a no.
// Beside nuisances that nobody declared: the noise is reached on all records, and no other
// candidate gains a tenth as much.
TEST(ClosesAlone, NoiseIsLeftAndNoOtherCandidateComesNear) {
  const FitResult before = FitWith(1.011, 1.028), after = FitWith(0.992, 1.001);
  EXPECT_TRUE(ClosesAlone(before, after, 183, -2.4));
  EXPECT_FALSE(ClosesAlone(before, after, 183, 19));   // another one explains it too
  EXPECT_FALSE(ClosesAlone(before, after, 90, -2.4));  // too little to be more than chance
  EXPECT_FALSE(ClosesAlone(before, FitWith(0.992, 1.012), 183, 0));  // something is left
  EXPECT_FALSE(ClosesAlone(FitWith(1.011, 1.008), after, 183, 0));   // integrators differ by that
  EXPECT_FALSE(ClosesAlone(before, FitWith(0.992, 1.001, 4, 9), 183, 0));  // impossible parameters
}

TEST(WorthAdopting, IsMonotonous) {
  const std::vector<double> ratios = {1.0, 1.05, 1.2, 1.6, 2.2, 3.0, 4.0};
  const std::vector<double> gains = {10, 25, 150, 250, 1e4};
  for (const int round : {0, 1, 2})
    for (const double before : ratios)
      for (const double penalty : {0.0, 50.0})
        for (std::size_t g = 0; g < gains.size(); ++g)
          for (std::size_t a = 0; a < ratios.size(); ++a) {
            const auto worth = [&](double gain, double after) {
              return WorthAdopting(FitWith(before, before, 4, penalty), FitWith(after, after), gain,
                                   round, 5);
            };
            if (!worth(gains[g], ratios[a])) continue;
            if (g + 1 < gains.size()) {
              EXPECT_TRUE(worth(gains[g + 1], ratios[a]));
            }
            if (a > 0) {
              EXPECT_TRUE(worth(gains[g], ratios[a - 1]));
            }
          }
}

TEST(StageRatios, TheWorstRecordCountsWithSomeAllowance) {
  EXPECT_DOUBLE_EQ((StageRatios{1, 2, 1.5}.Answered()), 2);
  EXPECT_DOUBLE_EQ((StageRatios{3, 2, 1.5}.Answered()), 3);
  EXPECT_DOUBLE_EQ((StageRatios{1, 1, 5.5}.Answered()), 5);
}

TEST(VerdictOf, NothingIsMissingBelowSevenPercent) {
  const ParameterNeed none;
  EXPECT_EQ(VerdictOf({1.0, 1.07, 1}, {1, 1, 1}, none, FoundEffect::kNone),
            ExplanationVerdict::kNone);
  EXPECT_EQ(VerdictOf({1.0, 1.08, 1}, {1, 1, 1}, none, FoundEffect::kNone),
            ExplanationVerdict::kParameters);
}

// One channel of many that the parameters bring to the noise.
TEST(VerdictOf, AChannelMayNeedTheParameters) {
  const ParameterNeed none;
  EXPECT_EQ(VerdictOf({1.06, 1.05, 1.1, 2.2}, {1.01, 1.01, 1.05, 1.1}, none, FoundEffect::kNone),
            ExplanationVerdict::kParameters);
  EXPECT_EQ(VerdictOf({1.06, 1.05, 1.1, 2.2}, {1.06, 1.05, 1.1, 2.1}, none, FoundEffect::kNone),
            ExplanationVerdict::kNone);
  EXPECT_EQ(VerdictOf({1.0, 1.0, 1.0, 1.2}, {0.99, 0.99, 1.0, 1.0}, none, FoundEffect::kNone),
            ExplanationVerdict::kNone);
}

TEST(VerdictOf, ImpossibleParametersAreUnknownWhateverTheyExplain) {
  const StageRatios before = {4, 4, 4}, after = {1, 1, 1};
  EXPECT_EQ(VerdictOf(before, after, {4.9, true, true}, FoundEffect::kNone),
            ExplanationVerdict::kParameters);
  EXPECT_EQ(VerdictOf(before, after, {5.0, true, true}, FoundEffect::kNone),
            ExplanationVerdict::kUnknown);
  EXPECT_EQ(VerdictOf(before, after, {1, false, true}, FoundEffect::kNone),
            ExplanationVerdict::kUnknown);
  EXPECT_EQ(VerdictOf(before, after, {2.9, true, false}, FoundEffect::kNone),
            ExplanationVerdict::kParameters);
  EXPECT_EQ(VerdictOf(before, after, {3.0, true, false}, FoundEffect::kNone),
            ExplanationVerdict::kUnknown);
}

TEST(VerdictOf, ATraceOfALargeMisfitMayStay) {
  const ParameterNeed none;
  EXPECT_EQ(VerdictOf({20, 20, 20}, {1.4, 1.4, 1.4}, none, FoundEffect::kNone),
            ExplanationVerdict::kParameters);
  EXPECT_EQ(VerdictOf({20, 20, 20}, {1.6, 1.6, 1.6}, none, FoundEffect::kNone),
            ExplanationVerdict::kUnknown);
  EXPECT_EQ(VerdictOf({2, 2, 2}, {1.4, 1.4, 1.4}, none, FoundEffect::kNone),
            ExplanationVerdict::kUnknown);  // no trace of it
}

// An effect that explains what stays says that something is missing, though its name is in doubt.
TEST(VerdictOf, WhatAnEffectExplainsIsNoTrace) {
  const ParameterNeed none;
  EXPECT_EQ(VerdictOf({20, 20, 20}, {1.4, 1.4, 1.4}, none, FoundEffect::kDoubtful),
            ExplanationVerdict::kUnknown);
  EXPECT_EQ(VerdictOf({20, 20, 20}, {1.05, 1.05, 1.05}, none, FoundEffect::kDoubtful),
            ExplanationVerdict::kParameters);
}

// Squared errors above the noise of 99 and 3: the fitted records hold nearly all of it.
TEST(ShareOfAllRecords, WeighsEachKindByItsError) {
  const double root = std::sqrt(1.99);  // leaves 0.99 of 99
  EXPECT_NEAR(ShareOfAllRecords({10, 2, 0}, {root, 1, 0}), (99 * 0.99 + 3) / 102, 1e-12);
  EXPECT_NEAR(ShareOfAllRecords({2, 2, 0}, {1, 2, 0}), 0.5, 1e-12);
  // a rotor that is lost on unseen records outweighs what the fitted ones show
  EXPECT_NEAR(ShareOfAllRecords({2, kInfinity, 0}, {2, 3, 0}), 1, 1e-9);
  EXPECT_NEAR(ShareOfAllRecords({2, kInfinity, 0}, {1, kInfinity, 0}), 0, 1e-9);
}

TEST(ShareOfAllRecords, UnseenRecordsMayNotContradict) {
  EXPECT_NEAR(ShareOfAllRecords({10, 2, 0}, {1, 2, 0}), 0.5, 1e-12);  // nothing of theirs explained
  EXPECT_NEAR(ShareOfAllRecords({10, 2, 0}, {1, 2.5, 0}), 0.5, 1e-12);
  EXPECT_NEAR(ShareOfAllRecords({10, 1.05, 0}, {1, 1.05, 0}), 1, 1e-12);  // they do not show it
  EXPECT_NEAR(ShareOfAllRecords({10, 1.2, 0}, {1, 1.2, 0}), 0.5, 1e-12);  // a fifth above: they do
}

// Quantiles of chi squared at 0.999, from a table; the approximation is 2 % off for two.
TEST(Possible, ShiftsThatChanceMakesMoreThanOnceInAThousand) {
  const std::vector<std::pair<int, double>> quantiles = {{2, 13.82}, {7, 24.32}, {11, 31.26}};
  for (const auto& [priors, quantile] : quantiles) {
    EXPECT_TRUE(Possible(FitWith(1, 1, priors, 0.96 * quantile))) << priors;
    EXPECT_FALSE(Possible(FitWith(1, 1, priors, 1.04 * quantile))) << priors;
  }
  EXPECT_TRUE(Possible(FitWith(1, 1, 0)));
}

}  // namespace
}  // namespace ambrig
