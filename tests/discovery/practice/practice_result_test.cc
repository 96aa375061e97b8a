// What explain said against what was hidden, counted by hand.
#include "discovery/practice/practice_result.h"

#include <gtest/gtest.h>

namespace ambrig {
namespace {

PracticeResult OneEffect(const std::string& name, const std::string& said, double probability) {
  PracticeResult r;
  r.name = name;
  r.kind = "one";
  r.families = {"saturation by powers"};
  r.laws = {"saturation-power@A"};
  r.answer = {{"effect"}, {{{"saturation", "A"}}}};
  r.finding.verdict = "effect";
  r.finding.first = {said, "A"};
  r.finding.adopted = {{said, "A"}};
  r.stated.members = {{said, "A", probability},
                      {"unknown", "", 1 - probability},
                      {"quiet", "", 0},
                      {"data", "", 0}};
  r.set = {{said, "A", probability}};
  return r;
}

PracticeResult WrongData(const std::string& verdict) {
  PracticeResult r;
  r.name = "data";
  r.kind = "data";
  r.mistake = "sign: record-1: sign of A.x";
  r.answer = {{"data"}, {}};
  r.finding.verdict = verdict;
  r.stated.members = {{"unknown", "", 0.1}, {"quiet", "", 0}, {"data", "", 0.9}};
  r.set = {{verdict, "", 0.9}};
  return r;
}

TEST(PracticeResults, RightAnswersByName) {
  const Answer effect = {{"effect"}, {{{"saturation", "A"}, {"iron-reluctance", "A"}}}};
  EXPECT_TRUE(IsRightAnswer(effect, "iron-reluctance", "A"));
  EXPECT_FALSE(IsRightAnswer(effect, "iron-reluctance", "B"));
  EXPECT_FALSE(IsRightAnswer(effect, "unknown", ""));
  const Answer nothing = {{"none"}, {}};
  EXPECT_TRUE(IsRightAnswer(nothing, "parameters", ""));
  EXPECT_TRUE(IsRightAnswer(nothing, "quiet", ""));
  EXPECT_FALSE(IsRightAnswer(nothing, "data", ""));
}

// Two right at 0.95, one wrong at 0.85, data recognised at 0.9, data missed: of five 3 right, error
// over bins: (0.8, 0.9]: stated (0.85 + 0.9 + 0.9)/3, found 2/3; (0.9, 1]: 0.95 against 1.
TEST(PracticeResults, CountsByHand) {
  std::vector<PracticeResult> all = {
      OneEffect("a", "saturation", 0.95), OneEffect("b", "saturation", 0.95),
      OneEffect("c", "unbalance", 0.85), WrongData("data"), WrongData("unknown")};
  const PracticeSummary s = Summarise(all, nullptr);
  ASSERT_EQ(s.counts.size(), 3U);
  EXPECT_EQ(s.counts[0].kind, "all");
  EXPECT_EQ(s.counts[0].right.right, 3U);
  EXPECT_EQ(s.counts[0].in_set.right, 3U);
  EXPECT_EQ(s.counts[0].verdict.right, 4U);
  EXPECT_EQ(s.data_recognised.right, 1U);
  EXPECT_EQ(s.data_recognised.of, 2U);
  EXPECT_EQ(s.named_from_wrong_data, 0U);
  EXPECT_EQ(s.by_family.at("saturation by powers").at("right effect"), 2);
  EXPECT_EQ(s.by_family.at("saturation by powers").at("unbalance"), 1);
  EXPECT_EQ(s.by_mistake.at("sign").at("unknown"), 1);
  // both wrong data state "data" at 0.9, the right answer whatever the verdict was
  const double stated = (0.85 + 0.9 + 0.9) / 3;
  EXPECT_NEAR(s.error.value, 0.6 * (stated - 2.0 / 3) + 0.4 * 0.05, 1e-12);
}

TEST(PracticeResults, AFailureIsWrongAndIsCounted) {
  PracticeResult r = OneEffect("a", "saturation", 0.95);
  r.failure = "no memory";
  r.finding.adopted.clear();
  const PracticeSummary s = Summarise({r}, nullptr);
  EXPECT_EQ(s.failed, 1U);
  EXPECT_EQ(s.counts[0].right.right, 0U);
  EXPECT_EQ(s.counts[0].in_set.right, 0U);
  EXPECT_TRUE(CalibrationCases({r}).empty());
}

// One half of twenty overconfident cases: calibration lowers the probability of the best.
TEST(PracticeResults, CalibrationChangesTheStatement) {
  std::vector<PracticeResult> all;
  for (int k = 0; k < 40; ++k)
    all.push_back(OneEffect("c", k % 2 ? "saturation" : "unbalance", 0.99));
  const CalibrationTable table = MakeCalibration(CalibrationCases(all));
  EXPECT_EQ(table.cases, 40);
  const JudgedResult before = JudgeResult(all[1], nullptr), after = JudgeResult(all[1], &table);
  EXPECT_NEAR(before.best.probability, 0.99, 1e-12);
  EXPECT_LT(after.best.probability, 0.65);
  EXPECT_TRUE(after.best.right);
}

}  // namespace
}  // namespace ambrig
