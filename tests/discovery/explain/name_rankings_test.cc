// Which names of rankings that are written down stay open, are doubtful, or were compared.
#include "discovery/explain/name_rankings.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

RankedEffect NameOf(const std::string& effect, const std::string& target, double probability,
                    double ratio) {
  RankedEffect r;
  r.effect = MakeInstance(EffectNamed(effect), target);
  r.fit.hypothesis.AddEffect(r.effect);
  r.fit.sd.assign(r.fit.hypothesis.free.size(), 0);
  r.probability = probability;
  r.fit.ratio_fit = ratio;
  return r;
}

std::vector<std::string> RivalNames(const std::vector<EffectInstance>& effects) {
  std::vector<std::string> names;
  for (const EffectInstance& e : effects) names.push_back(Named(e));
  return names;
}

AdoptedEffects AdoptedOf(const std::vector<RankedEffect>& ranked) {
  AdoptedEffects adopted(0);
  FitResult fit;
  for (const RankedEffect& r : ranked) fit.hypothesis.AddEffect(r.effect);
  fit.sd.assign(fit.hypothesis.free.size(), 0);
  adopted.Take(fit, ranked.size());
  return adopted;
}

RankedEffect GainAx() { return NameOf("sensor-gain", "A.x", 0.9, 2.0); }
RankedEffect OffsetAx() { return NameOf("sensor-offset", "A.x", 0.09, 2.05); }
RankedEffect OffsetBx() { return NameOf("sensor-offset", "B.x", 0.01, 4.0); }

TEST(NameRankings, RivalsAreTheOpenNamesOfTheOwnRoundAndTheNearOnesOfOthers) {
  NameRankings names;
  names.NoteRound(0, {GainAx(), OffsetAx(), OffsetBx()});
  const RankedEffect found = NameOf("sensor-offset", "A.y", 0.97, 1.0);
  names.NoteRound(1, {found, NameOf("sensor-gain", "B.y", 0.02, 1.04),
                      NameOf("sensor-gain", "B.x", 0.01, 1.2)});
  const AdoptedEffects adopted = AdoptedOf({GainAx(), found});
  // of the first one: the offset at A.x is open in its round, the gain of B.y came near in the
  // other one
  EXPECT_THAT(RivalNames(names.RivalsOf(adopted, 0)),
              ElementsAre("sensor-offset at A.x", "sensor-gain at B.y"));
  // of the second one: the gain at B.y is open there; 2.05 lies within a twentieth of 2
  EXPECT_THAT(RivalNames(names.RivalsOf(adopted, 1)),
              ElementsAre("sensor-offset at A.x", "sensor-gain at B.y"));
}

// Beside another effect the laws of both are fitted again, and one of them follows the iron's curve
// far worse.
TEST(NameRankings, NamesThatShareACurveKeepTheirOdds) {
  RankedEffect nearer = NameOf("iron-reluctance", "A", 0.8, 1.6),
               other = NameOf("saturation", "A", 0.2, 7.5);
  for (RankedEffect* r : {&nearer, &other}) r->shares_curve = true;
  NameRankings names;
  names.NoteRound(0, {nearer, other, NameOf("hysteresis", "A", 0.0, 2.6)});
  std::vector<RankedEffect> again = {NameOf("iron-reluctance", "A", 0, 1.5),
                                     NameOf("hysteresis", "A", 0, 2.6),
                                     NameOf("saturation", "A", 0, 7.5)};
  again[0].score = 100, again[1].score = 300, again[2].score = 900;
  EXPECT_TRUE(names.KeepSharedCurve(again));
  EXPECT_NEAR(again[2].score, 100 + 2 * std::log(4), 1e-9);
  EXPECT_EQ(again[1].score, 300);
  EXPECT_FALSE(names.KeepSharedCurve(again));
}

TEST(NameRankings, AnEffectOfItsOwnChannelsHasRivalsAtItsPlaceOnly) {
  NameRankings names;
  names.NoteRound(0, {GainAx(), OffsetAx(), NameOf("sensor-offset", "B.x", 0.05, 2.1)});
  AdoptedEffects adopted = AdoptedOf({GainAx()});
  EXPECT_EQ(names.RivalsOf(adopted, 0).size(), 2u);
  adopted.NoteOwnChannels(GainAx().effect);
  EXPECT_THAT(RivalNames(names.RivalsOf(adopted, 0)), ElementsAre("sensor-offset at A.x"));
}

TEST(NameRankings, WhatAComparisonDidNotLookAtFollowsWithoutProbability) {
  NameRankings names;
  names.NoteRound(0, {GainAx(), OffsetAx(), OffsetBx()});
  RankedEffect again = OffsetAx();
  again.probability = 0.8;
  names.NoteComparison(AdoptedOf({GainAx()}), 0, {again, GainAx()});
  std::vector<std::string> order;
  for (const RankedEffect& r : names.first()) order.push_back(Named(r.effect));
  EXPECT_THAT(order,
              ElementsAre("sensor-offset at A.x", "sensor-gain at A.x", "sensor-offset at B.x"));
  EXPECT_EQ(names.first()[0].probability, 0.8);
  EXPECT_EQ(names.first()[2].probability, 0);
}

TEST(NameRankings, ANameIsDoubtfulOnlyWhereItWasComparedAndLost) {
  NameRankings names;
  const RankedEffect second = NameOf("sensor-offset", "A.y", 0.2, 1.0);
  EXPECT_FALSE(names.IsDoubtful(second.effect, 0.3));
  names.NoteComparison(AdoptedOf({GainAx(), second}), 1,
                       {second, NameOf("sensor-gain", "A.y", 0.2, 1)});
  EXPECT_TRUE(names.IsDoubtful(second.effect, 0.3));
  EXPECT_FALSE(names.IsDoubtful(second.effect, 0.2));
  names.ForgetComparison(second.effect);
  EXPECT_FALSE(names.IsDoubtful(second.effect, 0.3));
}

TEST(NameRankings, ShapesCompareTwoNamesWhereOneRoundHasBoth) {
  RankedEffect gain = GainAx(), offset = OffsetAx();
  gain.shaped = StageRatios{1, 1, 1, 1};
  NameRankings names;
  names.NoteRound(0, {gain, offset});
  EXPECT_FALSE(names.ComparedByShape(gain.effect, offset.effect));
  offset.shaped = gain.shaped;
  names.NoteRound(1, {offset});
  EXPECT_FALSE(names.ComparedByShape(gain.effect, offset.effect));  // in two rounds
  names.NoteRound(2, {gain, offset});
  EXPECT_TRUE(names.ComparedByShape(gain.effect, offset.effect));
}

TEST(NameRankings, RoundsAreTakenBack) {
  NameRankings names;
  names.NoteRound(0, {GainAx()});
  const NameRankings::State before = names.Now();
  names.NoteRound(1, {OffsetAx()});
  const AdoptedEffects adopted = AdoptedOf({GainAx()});
  EXPECT_EQ(names.RivalsOf(adopted, 0).size(), 1u);
  names.BackTo(before);
  EXPECT_THAT(names.RivalsOf(adopted, 0), IsEmpty());
  Explanation out;
  names.MoveTo(out);
  EXPECT_EQ(out.ranking.size(), 1u);
  EXPECT_THAT(out.second_round, IsEmpty());
}

// A checkpoint is written while the search goes on with them.
TEST(NameRankings, ACopyHasNoSensitivities) {
  RankedEffect fitted = GainAx();
  fitted.fit.jacobian = Eigen::MatrixXd::Ones(4, 1);
  NameRankings names;
  names.NoteRound(0, {fitted});
  Explanation so_far;
  names.CopyTo(so_far);
  ASSERT_EQ(so_far.ranking.size(), 1u);
  EXPECT_EQ(so_far.ranking[0].fit.jacobian.size(), 0);
  EXPECT_EQ(names.first()[0].fit.jacobian.size(), 4);
}

}  // namespace
}  // namespace ambrig
