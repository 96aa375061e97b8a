// The last round of a search after its end: its names and probabilities agree with what was
// adopted.
#include "discovery/decision/second_round.h"

#include <gmock/gmock.h>

#include "effects/catalogue.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A round of two candidates beside the gain of A.x, of a rig file without effects.
Explanation TwoRounds() {
  Explanation e;
  e.adopted = {LinearCase::Gain(1.08)};
  for (const char* axis : {"A.y", "B.y"}) {
    RankedEffect r;
    r.effect = MakeInstance(EffectNamed("sensor-offset"), axis);
    r.probability = e.second_round.empty() ? 0.99 : 0.01;
    r.fit.hypothesis.rig.effects = {e.adopted[0], r.effect};
    e.second_round.push_back(r);
  }
  return e;
}

TEST(SecondRound, OfWhichNothingWasAdoptedHasNoProbabilities) {
  Explanation e = TwoRounds();
  SettleSecondRound(0, e);
  EXPECT_THAT(e.second_beside, ElementsAre(Named(e.adopted[0])));
  for (const RankedEffect& r : e.second_round) EXPECT_EQ(r.probability, 0);
  EXPECT_THAT(SecondRoundTitle(e), HasSubstr("beside " + Named(e.adopted[0]) + ": none of them"));
}

// Beside all that was found names are judged again: that is what counts, and it is what the sets
// say.
TEST(SecondRound, OfWhichOneWasAdoptedHasThoseBesideTheOthers) {
  Explanation e = TwoRounds();
  e.adopted.push_back(e.second_round[0].effect);
  SettleSecondRound(0, e);
  EXPECT_EQ(e.second_round[0].probability, 0.99);
  RankedEffect again = e.second_round[0];
  again.probability = 0.5;
  e.beside[Named(again.effect)] = {again};
  SettleSecondRound(0, e);
  EXPECT_EQ(e.second_round[0].probability, 0.5);
  EXPECT_EQ(e.second_round[1].probability, 0);
  EXPECT_THAT(SecondRoundTitle(e), HasSubstr("one of them was adopted"));
}

// Effects that the rig file has are none that were found.
TEST(SecondRound, TheRigFilesOwnEffectsAreNotNamed) {
  Explanation e = TwoRounds();
  SettleSecondRound(1, e);
  EXPECT_TRUE(e.second_beside.empty());
}

}  // namespace
}  // namespace ambrig
