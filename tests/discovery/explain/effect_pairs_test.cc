// Which pairs the steps one by one have fitted already.
#include "discovery/explain/effect_pairs.h"

#include <gtest/gtest.h>

#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

TEST(EffectPairs, ArePassedOverWhereTheStepsHaveFittedThem) {
  const LinearCase c({1e-5, 2e-5}, 1, 0);
  SearchModels models(c.data, nullptr, nullptr);
  const ExplainOptions options;
  const SearchProgress progress(options, models);
  SearchLog log;
  AdoptedEffects adopted(0);
  const EffectPairs pairs(models, adopted, log, progress);
  const EffectInstance gain = LinearCase::Gain(1.1), offset = LinearCase::Offset(1e-6),
                       other = MakeInstance(EffectNamed("sensor-gain"), "B.x");
  const CandidatePair both = {gain, offset};
  EXPECT_FALSE(pairs.AlreadyTried(both));
  FitResult fit;
  fit.hypothesis = c.With({gain, offset});
  fit.sd.assign(fit.hypothesis.free.size(), 0);
  adopted.Take(fit, 1);
  EXPECT_TRUE(pairs.AlreadyTried(both));  // the second round tried the offset beside the gain
  EXPECT_FALSE(pairs.AlreadyTried({offset, other}));
  adopted.Take(fit, 2);
  EXPECT_TRUE(pairs.AlreadyTried(both));
  EXPECT_FALSE(pairs.AlreadyTried({gain, other}));
}

}  // namespace
}  // namespace ambrig
