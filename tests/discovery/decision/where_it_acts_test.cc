// Evidence in the channels where an effect acts, against errors written down by hand.
#include "discovery/decision/where_it_acts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "discovery/search/local_share.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

/// Errors over the noise of A.x and A.y: in the fitted records, then in the unseen one.
struct Errors {
  double x, y, unseen_x, unseen_y;
};

FitResult WithErrors(const LinearCase& c, const Errors& e) {
  FitResult fit;
  fit.converged = true;
  fit.residual.resize(c.model.size());
  for (const Target& t : c.model.targets()) {
    const bool unseen = c.data.records[t.record].validate, y = t.channel == 1;
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      fit.residual[k] = unseen ? (y ? e.unseen_y : e.unseen_x) : (y ? e.y : e.x);
  }
  return fit;
}

const std::vector<double> kThreeRecords = {2e-5, 4e-5, 6e-5};
constexpr double kPlainGain = 100;  // of the score

// A.y keeps what the law of an earlier effect leaves; A.x is explained down to the noise.
TEST(ShareWhereItActs, IsOfTheChannelsWhoseErrorFalls) {
  const LinearCase c(kThreeRecords, 1, 0);
  const FitResult before = WithErrors(c, {3, 4, 3, 4}), after = WithErrors(c, {1, 4, 1.5, 4});
  const LocalShare share = ShareWhereItActs(c.model, before.residual, after.residual);
  EXPECT_NEAR(share.before, 3, 1e-12);
  EXPECT_NEAR(share.explained, 1, 1e-12);
  EXPECT_TRUE(share.seen_there);
  EXPECT_NEAR(share.unseen, (9 - 2.25) / (9 - 1), 1e-12);
  EXPECT_TRUE(ExplainsItsChannels(c.model, before, after, kPlainGain, false));
}

// Four fifths of the fall: here it takes both channels.
TEST(ShareWhereItActs, IsOfAllChannelsWhereAllFallAlike) {
  const LinearCase c(kThreeRecords, 1, 0);
  const FitResult before = WithErrors(c, {3, 4, 3, 4}), after = WithErrors(c, {2, 3, 2, 3});
  const LocalShare share = ShareWhereItActs(c.model, before.residual, after.residual);
  EXPECT_NEAR(share.before, std::sqrt((9.0 + 16) / 2), 1e-12);
  EXPECT_NEAR(share.explained, (9.0 + 16 - 4 - 9) / (9 + 16 - 2), 1e-12);
  EXPECT_FALSE(ExplainsItsChannels(c.model, before, after, kPlainGain, false));
}

TEST(ShareWhereItActs, UnseenRecordsMayContradict) {
  const LinearCase c(kThreeRecords, 1, 0);
  const FitResult before = WithErrors(c, {3, 4, 3, 4});
  EXPECT_FALSE(
      ExplainsItsChannels(c.model, before, WithErrors(c, {1, 4, 2.7, 4}), kPlainGain, false));
  // Where they show no error they have no say.
  EXPECT_TRUE(ExplainsItsChannels(c.model, WithErrors(c, {3, 4, 1, 4}), WithErrors(c, {1, 4, 1, 4}),
                                  kPlainGain, false));
}

// A held rotor feels no bending: what the mode's law leaves in a record of the free one says
// nothing of what is explained in those of the held one.
TEST(ShareWhereItActs, RecordsThatFeelNoEarlierEffectDecideAlone) {
  const LinearCase c(kThreeRecords, 1, 0);
  Case data = c.data;
  data.records.back().scenario.start = StartState::kLevitated;
  const CaseModel model(data);
  FitResult before = WithErrors(c, {3, 4, 3, 4});
  const FitResult after = WithErrors(c, {1, 4, 2.7, 4});
  EXPECT_FALSE(ExplainsItsChannels(model, before, after, kPlainGain, false));
  before.hypothesis.rig.effects = {MakeInstance(EffectNamed("bending-mode"), "rig")};
  EXPECT_TRUE(ExplainsItsChannels(model, before, after, kPlainGain, false));
  before.hypothesis.rig.effects = {LinearCase::Gain(1.1)};
  EXPECT_FALSE(ExplainsItsChannels(model, before, after, kPlainGain, false));
}

// A run-out that takes what a coupling's law leaves in the fitted records makes an error in the
// unseen one, elsewhere than in its own channels.
TEST(ShareWhereItActs, WhatMakesUnseenRecordsWorseIsNoEffect) {
  const LinearCase c(kThreeRecords, 1, 0);
  FitResult before = WithErrors(c, {3, 4, 1, 4}), after = WithErrors(c, {1, 4, 1, 4});
  before.ratio_validate = 1.03;
  after.ratio_validate = 1.06;
  EXPECT_TRUE(ExplainsItsChannels(c.model, before, after, kPlainGain, false));
  after.ratio_validate = 1.21;
  EXPECT_FALSE(ExplainsItsChannels(c.model, before, after, kPlainGain, false));
}

TEST(ShareWhereItActs, LittleErrorOrLittleEvidenceIsNotEnough) {
  const LinearCase c(kThreeRecords, 1, 0);
  const FitResult after = WithErrors(c, {1, 4, 1, 4});
  EXPECT_FALSE(
      ExplainsItsChannels(c.model, WithErrors(c, {1.05, 4, 1.05, 4}), after, kPlainGain, false));
  EXPECT_FALSE(ExplainsItsChannels(c.model, WithErrors(c, {3, 4, 3, 4}), after, 10, false));
  FitResult lost = after;
  lost.converged = false;
  EXPECT_FALSE(ExplainsItsChannels(c.model, WithErrors(c, {3, 4, 3, 4}), lost, kPlainGain, false));
}

// What is explained to the noise there is an effect of its own, however little stood there and
// whichever was adopted before; of what is nearly explained the first effect's parameters have not
// made room for what else is missing.
TEST(ShareWhereItActs, TheFirstEffectExplainsAllOfItsChannels) {
  const LinearCase c(kThreeRecords, 1, 0);
  const FitResult all = WithErrors(c, {1, 4, 1, 4}), nearly = WithErrors(c, {1.5, 4, 1.5, 4});
  for (const bool first : {true, false}) {
    EXPECT_TRUE(ExplainsItsChannels(c.model, WithErrors(c, {3, 4, 3, 4}), all, kPlainGain, first));
    EXPECT_TRUE(
        ExplainsItsChannels(c.model, WithErrors(c, {1.2, 4, 1.2, 4}), all, kPlainGain, first));
    EXPECT_FALSE(
        ExplainsItsChannels(c.model, WithErrors(c, {1.05, 4, 1.05, 4}), all, kPlainGain, first));
  }
  const FitResult before = WithErrors(c, {3, 4, 3, 4});
  EXPECT_TRUE(ExplainsItsChannels(c.model, before, nearly, kPlainGain, false));
  EXPECT_FALSE(ExplainsItsChannels(c.model, before, nearly, kPlainGain, true));
}

TEST(ShareWhereItActs, OfNothingThatFallsIsNothing) {
  const LinearCase c(kThreeRecords, 1, 0);
  const FitResult same = WithErrors(c, {3, 4, 3, 4});
  EXPECT_EQ(ShareWhereItActs(c.model, same.residual, same.residual).explained, 0);
}

}  // namespace
}  // namespace ambrig
