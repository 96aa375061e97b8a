// Parts of an answer that need no search.
#include "discovery/explain/explanation_report.h"

#include <gtest/gtest.h>

#include "tests/discovery/explain/search_parts.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

class ReportOfASearch : public testing::SearchParts {};

TEST_F(ReportOfASearch, WrongDataNameNothingThatWasAdopted) {
  ExplanationReport report(models_, adopted_, names_, log_, progress_);
  const FitResult base = models_.FitFrom(nominal_);
  Hypothesis h = base.hypothesis;
  h.AddEffect(LinearCase::Offset(1e-6));
  adopted_.AddLastOf(models_.FitFrom(h));
  log_.Step("parameters", base);
  EXPECT_EQ(report.SoFar().adopted.size(), 1u);
  EXPECT_EQ(report.SoFar().verdict, ExplanationVerdict::kUnfinished);
  DataFault sign;
  sign.fault = "sign";
  sign.probability = 0.99;
  report.NoteData({sign});
  const Explanation out = report.OfWrongData(base, base.ratio_validate);
  EXPECT_EQ(out.verdict, ExplanationVerdict::kData);
  EXPECT_TRUE(out.adopted.empty());
  EXPECT_TRUE(out.ranking.empty());
  EXPECT_EQ(out.ladder.size(), 1u);
  EXPECT_EQ(out.final_ratio_fit, base.ratio_fit);
}

}  // namespace
}  // namespace ambrig
