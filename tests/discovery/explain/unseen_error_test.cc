// An error that one validation record alone shows.
#include "discovery/explain/unseen_error.h"

#include <gmock/gmock.h>

namespace ambrig {
namespace {

/// Two fitted records and two unseen ones.
Case FourRecords() {
  Case c;
  for (const char* file : {"a.csv", "b.csv", "c.csv", "d.csv"}) {
    c.records.emplace_back();
    c.records.back().data_file = file;
  }
  c.records[2].validate = c.records[3].validate = true;
  return c;
}

Explanation Left(double fitted, const std::vector<RemainderPlace>& where) {
  Explanation e;
  e.verdict = ExplanationVerdict::kUnknown;
  e.final_ratio_fit = fitted;
  e.final_ratio_validate = 4;
  e.remainder.where = where;
  return e;
}

TEST(OnlyUnseen, IsTheWorstUnseenRecordWhereTheFittedOnesStandAtTheNoise) {
  const Case c = FourRecords();
  EXPECT_EQ(OnlyUnseen(c, Left(1.02, {{"d.csv", "omega", 30}, {"c.csv", "A.x", 4}})), 3U);
  EXPECT_EQ(OnlyUnseen(c, Left(1.02, {{"d.csv", "omega", 30}, {"a.csv", "A.x", 1.2}})), 3U);
}

TEST(OnlyUnseen, IsNothingWhereAFittedRecordShowsIt) {
  const Case c = FourRecords();
  EXPECT_FALSE(OnlyUnseen(c, Left(1.02, {{"d.csv", "omega", 30}, {"a.csv", "omega", 2}})));
  EXPECT_FALSE(OnlyUnseen(c, Left(1.3, {{"d.csv", "omega", 30}})));
  EXPECT_FALSE(OnlyUnseen(c, Left(1.02, {{"d.csv", "omega", 2}})));
  EXPECT_FALSE(OnlyUnseen(c, Left(1.02, {{"b.csv", "omega", 30}})));
}

TEST(OnlyUnseen, IsNothingWhereTheDataAreWrong) {
  Explanation e = Left(1.02, {{"d.csv", "omega", 30}});
  e.verdict = ExplanationVerdict::kData;
  EXPECT_FALSE(OnlyUnseen(FourRecords(), e));
}

TEST(TheBetter, TakesTheSecondAnswerOnlyIfItExplainsAll) {
  const Case c = FourRecords();
  const Explanation before = Left(1.02, {{"d.csv", "omega", 30}});
  Explanation again = before;
  again.verdict = ExplanationVerdict::kEffect;
  again.final_ratio_fit = again.final_ratio_validate = 1.01;
  EXPECT_EQ(TheBetter(c, 3, before, again).verdict, ExplanationVerdict::kEffect);
  again.final_ratio_fit = 1.4;
  const Explanation kept = TheBetter(c, 3, before, again);
  EXPECT_EQ(kept.verdict, ExplanationVerdict::kUnknown);
  ASSERT_EQ(kept.warnings.size(), 1U);
  EXPECT_THAT(kept.warnings[0], ::testing::HasSubstr("d.csv alone shows the error"));
}

TEST(WithFitted, ChangesOneRecordOfACopy) {
  const Case c = FourRecords();
  const Case fitted = WithFitted(c, 2);
  EXPECT_FALSE(fitted.records[2].validate);
  EXPECT_TRUE(fitted.records[3].validate);
  EXPECT_TRUE(c.records[2].validate);
}

}  // namespace
}  // namespace ambrig
