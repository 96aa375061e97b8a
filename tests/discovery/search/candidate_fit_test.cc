// Fits of candidates and their ranking, on readings that are linear in gain and offset.
#include "discovery/search/candidate_fit.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "discovery/search/effect_round.h"
#include "discovery/search/likelihood.h"
#include "discovery/search/visible_size.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

constexpr double kFitN = 300;
const std::vector<double> kX = {2e-5, 4e-5, 6e-5, 5e-5};

Candidate From(const EffectInstance& start) {
  Candidate c;
  c.effect = start;
  return c;
}

TEST(FitBriefly, ReachesTheOptimumOfALinearProblem) {
  const LinearCase c(kX, 1.08, 0);
  const FitResult fit = FitBriefly(c.model, c.Base(), From(LinearCase::Gain(1.01)), kFitN);
  ASSERT_TRUE(fit.converged);
  EXPECT_NEAR(fit.hypothesis.rig.effects[0].Value("gain"), 1.08, 2e-3);
  EXPECT_LT(fit.ratio_validate, 0.2);
  EXPECT_EQ(fit.jacobian.size(), 0);  // no sensitivities of a short fit
}

// At x = 50 to 52 um a gain and an offset stand in for each other: of an error of 10 floors less
// than one is left along the whole valley. The record kept back, at 80 um, shows where a fit ended.
TEST(FitShortly, FollowsAValleyToItsEnd) {
  const LinearCase c({5.0e-5, 5.1e-5, 5.2e-5, 8e-5}, 1.6, -2e-5);
  const Hypothesis start = c.With({LinearCase::Gain(1.01), LinearCase::Offset(0)});
  const FitResult fit = FitShortly(c.model, c.Base(), start, kFitN);
  ASSERT_TRUE(fit.converged);
  EXPECT_NEAR(fit.hypothesis.rig.effects[0].Value("gain"), 1.6, 0.1);
  EXPECT_LT(fit.ratio_validate, 1);
  FitOptions short_steps;  // these end on the side of the valley
  short_steps.effective_sample_size = kFitN;
  short_steps.passes = 1;
  EXPECT_GT(Fit(c.model, start, short_steps).ratio_validate, 3);
}

// A start that the case refuses is passed over, and no start at all is no fit.
TEST(FitBriefly, TakesTheOtherStartWhereTheFirstIsRefused) {
  const LinearCase c(kX, 1.08, 0);
  Candidate candidate = From(LinearCase::Gain(1.01));
  candidate.effect.target = "nowhere";
  FitResult fit = FitBriefly(c.model, c.Base(), candidate, kFitN);
  EXPECT_FALSE(fit.converged);
  EXPECT_TRUE(std::isinf(fit.ratio_fit));
  candidate.other_starts = {LinearCase::Gain(1.2)};
  fit = FitBriefly(c.model, c.Base(), candidate, kFitN);
  ASSERT_TRUE(fit.converged);
  EXPECT_EQ(fit.hypothesis.rig.effects.size(), 1u);
  EXPECT_EQ(fit.hypothesis.rig.effects[0].target, "A.x");
}

// A narrow effect that explains nothing wherever it starts is not there: nothing is fitted.
TEST(FitBriefly, ANarrowEffectThatExplainsNothingIsNotFitted) {
  const LinearCase c(kX, 1, 0);
  Candidate candidate = From(LinearCase::Gain(1.0001));
  candidate.other_starts = {LinearCase::Gain(0.9999)};
  EXPECT_TRUE(FitBriefly(c.model, c.Base(), candidate, kFitN).converged);
  candidate.narrow = true;
  const FitResult fit = FitBriefly(c.model, c.Base(), candidate, kFitN);
  EXPECT_FALSE(fit.converged);
  EXPECT_TRUE(std::isinf(fit.ratio_fit));
}

// Beside an effect that has its place the columns of that one are lent: the same optimum of a
// linear problem with fewer simulations.
TEST(FitBriefly, BesideAnEffectItsSensitivitiesAreLent) {
  long runs[2] = {};
  for (const bool lent : {false, true}) {
    const LinearCase c(kX, 1.08, 7e-6);  // one of its own: nothing is in memory
    const FitResult now = FitOn(c.model, c.Base(), c.With({LinearCase::Gain(1.02)}), kFitN);
    ASSERT_EQ(now.jacobian.cols(), 1);
    Candidate candidate;
    candidate.effect = LinearCase::Offset(2e-6);
    Hypothesis h = now.hypothesis;
    h.AddEffect(candidate.effect);
    const long start = c.model.runs;
    const FitResult fit =
        lent ? FitBriefly(c.model, now, candidate, kFitN) : FitShortly(c.model, now, h, kFitN);
    runs[lent ? 1 : 0] = c.model.runs - start;
    ASSERT_TRUE(fit.converged);
    EXPECT_NEAR(FittedEffect(fit, 0).Value("gain"), 1.08, 2e-3);
    EXPECT_NEAR(FittedEffect(fit, 1).Value("offset"), 7e-6, 1e-7);
  }
  EXPECT_LT(runs[1], runs[0]);
}

TEST(FitOn, GivesSensitivitiesAndStandardDeviations) {
  const LinearCase c(kX, 1.08, 2e-6);
  const FitResult base = c.Base();
  const FitResult fit =
      FitOn(c.model, base, c.With({LinearCase::Gain(1.05), LinearCase::Offset(1e-6)}), kFitN);
  ASSERT_TRUE(fit.converged);
  EXPECT_EQ(fit.jacobian.cols(), 2);
  ASSERT_EQ(fit.sd.size(), 2u);
  EXPECT_GT(fit.sd[0], 0);
  EXPECT_NEAR(fit.hypothesis.free[1].value, 2e-6, 2e-7);
}

/// Records every text of progress.
struct Told {
  std::vector<std::string> texts;
  std::function<void(double, const std::string&)> Listener() {
    return [this](double f, const std::string& text) {
      EXPECT_GE(f, 0);
      EXPECT_LE(f, 1);
      texts.push_back(text);
    };
  }
};

TEST(RankEffects, TheEffectThatMadeTheDataComesFirst) {
  const LinearCase c(kX, 1.08, 0);
  const FitResult base = c.Base();
  SignatureBank bank;
  Told told;
  const EffectRound round =
      RankEffects({c.model, c.model, bank, kFitN, 3, told.Listener()}, base, 0);
  ASSERT_GE(round.ranking.size(), 2u);
  const RankedEffect& best = round.ranking[0];
  EXPECT_EQ(Named(best.effect), "sensor-gain at A.x");
  EXPECT_NEAR(best.effect.Value("gain"), 1.08, 2e-3);
  EXPECT_GT(best.effect.sd[0], 0);  // of a full fit
  EXPECT_GT(best.fit.jacobian.size(), 0);
  EXPECT_NEAR(best.screened_ratio, best.fit.ratio_validate, 0.1);  // linear: the promise is kept
  double sum = 0;
  for (std::size_t k = 0; k < round.ranking.size(); ++k) {
    const RankedEffect& r = round.ranking[k];
    sum += r.probability;
    EXPECT_NEAR(r.score, Score(c.model, r.fit, kFitN), 1e-9);
    EXPECT_NEAR(std::log(r.probability / best.probability), -0.5 * (r.score - best.score), 1e-6);
    if (k > 0) {
      EXPECT_GE(r.score, round.ranking[k - 1].score);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_FALSE(round.screened.empty());
  EXPECT_THAT(told.texts, ::testing::Contains("full fit of sensor-gain at A.x"));
}

// One candidate is asked for, but a name given without the other laws of its place would be too
// sure: those that promise a third of the error are fitted too, at this place only.
TEST(RankEffects, RivalsAtThePlaceOfTheBestAreFittedToo) {
  const LinearCase c(kX, 1.3, 0);
  const FitResult base = c.Base();
  SignatureBank bank;
  Told told;
  const EffectRound round =
      RankEffects({c.model, c.model, bank, kFitN, 1, told.Listener()}, base, 0);
  ASSERT_GE(round.ranking.size(), 2u);
  EXPECT_EQ(Named(round.ranking[0].effect), "sensor-gain at A.x");
  bool offset = false;
  for (const RankedEffect& r : round.ranking) {
    EXPECT_EQ(r.effect.target, "A.x");
    offset = offset || r.effect.name == "sensor-offset";
  }
  EXPECT_TRUE(offset);
  EXPECT_GT(round.ranking[0].probability, 0.99);  // of readings at four places a gain is plain
  // The short fits left nothing open: the second one needs no full fit.
  EXPECT_EQ(std::count_if(told.texts.begin(), told.texts.end(),
                          [](const std::string& t) { return t.starts_with("full fit of"); }),
            1);
}

// A second round adds to what was found and does not name it again.
TEST(RankEffects, ASecondRoundFindsWhatTheFirstLeft) {
  const LinearCase c({2e-5, 4e-5, 6e-5, -5e-5}, 1.1, -8e-6);
  const FitResult base = c.Base();
  SignatureBank bank;
  Told told;
  const RoundSetting setting{c.model, c.model, bank, kFitN, 3, told.Listener()};
  FitResult now = FitOn(c.model, base, c.With({LinearCase::Gain(1.05)}), kFitN);
  ASSERT_TRUE(now.converged);
  ASSERT_GT(now.ratio_validate, 1);
  const EffectRound round = RankEffects(setting, now, 1);
  ASSERT_FALSE(round.ranking.empty());
  EXPECT_EQ(Named(round.ranking[0].effect), "sensor-offset at A.x");
  EXPECT_NEAR(round.ranking[0].effect.Value("offset"), -8e-6, 3e-7);
  EXPECT_EQ(round.ranking[0].fit.hypothesis.rig.effects.size(), 2u);
  for (const RankedEffect& r : round.ranking)
    EXPECT_FALSE(r.effect.name == "sensor-gain" && r.effect.target == "A.x");
}

// An offset of 2 floors in one channel of two leaves a ratio of 1.4, in which a tone may still
// hide; one of 1.2 leaves none.
TEST(RankEffects, ALaterRoundSeeksFrequenciesWhereAnErrorIsLeft) {
  for (const double offset : {2e-6, 1.2e-6}) {
    const LinearCase c(kX, 1, offset);
    const FitResult base = c.Base();
    SignatureBank bank;
    Told told;
    const EffectRound round =
        RankEffects({c.model, c.model, bank, kFitN, 1, told.Listener()}, base, 1);
    const bool sought =
        std::any_of(round.screened.begin(), round.screened.end(),
                    [](const Candidate& s) { return s.effect.name == "sensor-hum"; });
    EXPECT_EQ(sought, offset > 1.5e-6) << base.ratio_fit;
  }
}

TEST(VisibleSizes, AreThreeStandardDeviationsOfEachEffect) {
  const LinearCase c(kX, 1, 0);
  const FitResult base = c.Base();
  SignatureBank bank;
  bank.Simulate(c.model, base, ProbesOf(EffectNamed("sensor-offset"), "A.x", c.model, {}), nullptr);
  const std::vector<VisibleSize> sizes = VisibleSizes(c.model, base, kFitN, bank);
  ASSERT_EQ(sizes.size(), 1u);
  EXPECT_EQ(sizes[0].effect, "sensor-offset");
  EXPECT_EQ(sizes[0].target, "A.x");
  EXPECT_EQ(sizes[0].unit, "m");
  // One offset in the 3 x 50 fitted rows of A.x, each of weight kFitN over all rows.
  const double weight = kFitN / static_cast<double>(c.model.size());
  EXPECT_NEAR(sizes[0].size, 3 * LinearCase::kFloor / std::sqrt(weight * 3 * LinearCase::kRows),
              0.05 * sizes[0].size);
}

}  // namespace
}  // namespace ambrig
