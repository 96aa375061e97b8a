// Predictions of some records only, and signatures that are completed when more records are asked
// for.
#include "discovery/search/worst_records.h"

#include <gtest/gtest.h>

#include "discovery/search/signature_bank.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

// The error of a gain goes with the position: the records far out hold it.
const std::vector<double> kWorstRecordsX = {1e-6, 6e-5, 2e-6, 1.5e-6, 5e-5};

TEST(RecordSubset, RowsOfOtherRecordsAreTheOnesGiven) {
  const LinearCase c(kWorstRecordsX, 1.1, 0);
  const FitResult base = c.Base();
  Hypothesis h = base.hypothesis;
  h.AddEffect(LinearCase::Gain(1.2));
  const RecordSubset look{{0, 1, 0, 0, 0}, std::vector<double>(c.model.size(), 7)};
  const auto part = c.model.PredictAll({h}, ModelFidelity::kAsSampled, &look)[0];
  const auto all = c.model.Predict(h);
  ASSERT_TRUE(part && all);
  for (const Target& t : c.model.targets())
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      EXPECT_EQ((*part)[k], t.record == 1 ? (*all)[k] : 7);
}

TEST(RecordsShowing, AreThoseThatHoldNineTenthsOfTheError) {
  const LinearCase c(kWorstRecordsX, 1.1, 0);
  const FitResult base = c.Base();
  ASSERT_GT(base.ratio_fit, 2);
  const RecordSubset look = RecordsShowing(c.model, base);
  EXPECT_EQ(look.records, (std::vector<char>{0, 1, 0, 0, 1}));  // the last one is the unseen one
  EXPECT_EQ(look.rest, base.predicted);
}

TEST(RecordsShowing, AreAllWhereTheErrorIsHardlyAboveTheNoise) {
  const LinearCase c(kWorstRecordsX, 1.02, 0);
  const FitResult base = c.Base();
  ASSERT_LT(base.ratio_fit, 2);
  EXPECT_EQ(RecordsShowing(c.model, base).records, std::vector<char>(5, 1));
}

// An effect beside those adopted has to explain most of what is left.
TEST(RecordsShowing, BesideAnAdoptedEffectAreThoseThatHoldTheErrorHoweverSmall) {
  const LinearCase c(kWorstRecordsX, 1.1, 0);
  FitOptions there;
  there.iterations = 0;
  const FitResult beside = Fit(c.model, c.With({LinearCase::Gain(1.07)}), there);
  ASSERT_LT(beside.ratio_fit, 1.3);
  EXPECT_EQ(RecordsShowing(c.model, beside).records, (std::vector<char>{0, 1, 0, 0, 1}));
}

// Held rotors are not where resonances are sought, unless there are no others.
TEST(WorstRecords, AreAllWhereNoRotorIsFree) {
  const LinearCase c(kWorstRecordsX, 1.1, 0);
  EXPECT_EQ(WorstRecords(c.model, c.Base()).records, std::vector<char>(5, 1));
}

std::vector<ProbeGroup> GainAndOffset() {
  std::vector<ProbeGroup> groups(2);
  groups[0].probes = {LinearCase::Gain(1.05)};
  groups[1].probes = {LinearCase::Offset(3e-6)};
  for (ProbeGroup& g : groups) g.rows = {0};
  return groups;
}

TEST(SignatureBank, LacksRowsUntilTheirRecordIsLookedAt) {
  const LinearCase c(kWorstRecordsX, 1.1, 0);
  const FitResult base = c.Base();
  SignatureBank whole, part;
  whole.Simulate(c.model, base, GainAndOffset(), nullptr);
  EXPECT_FALSE(whole.partial());
  part.LookAt(c.model, {{0, 1, 0, 0, 1}, base.predicted});
  part.Simulate(c.model, base, GainAndOffset(), nullptr);
  EXPECT_TRUE(part.partial());
  const Gram all = whole.Products(c.model), some = part.Products(c.model);
  EXPECT_LT(some.fit(1, 1), 0.4 * all.fit(1, 1));  // an offset shows in each of four fitted records
  EXPECT_DOUBLE_EQ(some.validate(1, 1), all.validate(1, 1));
  part.LookAt(c.model, {{1, 0, 1, 1, 0}, base.predicted});
  EXPECT_FALSE(part.partial());
  const Gram& completed = part.Products(c.model);
  for (Eigen::Index i = 0; i < 2; ++i)
    for (Eigen::Index j = 0; j < 2; ++j) {
      EXPECT_DOUBLE_EQ(completed.fit(i, j), all.fit(i, j));
      EXPECT_DOUBLE_EQ(completed.validate(i, j), all.validate(i, j));
    }
}

}  // namespace
}  // namespace ambrig
