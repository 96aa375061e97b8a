// A detector study as text, JSON and page, from curves written by hand: what is told is what they
// hold.
#include <gmock/gmock.h>

#include <cmath>

#include "app/pages/detector_report.h"
#include "tests/app/browser.h"
#include "tests/app/html_page.h"

namespace ambrig {
namespace {

using testing::CountOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr auto kLevels = static_cast<std::size_t>(kStatisticLevels);

/// A fault that is found up to level `up_to`, always after `delay` [s].
FaultCurve Found(const std::string& kind, int up_to, double delay) {
  FaultCurve f;
  f.kind = kind;
  f.runs = 8;
  f.area = 0.75;
  for (int k = 0; k < kStatisticLevels; ++k) {
    const bool found = k <= up_to;
    f.detected.push_back(found ? 1 : 0.25);
    f.named.push_back(found ? 0.875 : 0.25);
    f.median.push_back(found ? delay : kInfinity);
    f.late.push_back(found ? 2 * delay : kInfinity);
  }
  return f;
}

/// Healthy windows stay below level `below`.
FalseAlarmCurve Alarms(const std::string& scenario, int below) {
  FalseAlarmCurve c;
  c.scenario = scenario;
  c.windows = 4000;
  for (int k = 0; k < kStatisticLevels; ++k) c.share.push_back(k < below ? 0.5 : 0);
  return c;
}

DetectorCurves Curves(const std::string& name, int below, int found, double delay) {
  DetectorCurves d;
  d.name = name;
  d.unit = name == "slope" ? "A" : "-";
  d.doc = "what " + name + " looks at";
  d.documented = name == "slope" ? 2.0 : kRequired;
  d.all = Alarms("all", below);
  d.scenarios = {Alarms("idle & warm", below)};
  d.faults = {Found("open", found, delay), Found("partial-short fraction=0.1", found - 40, delay)};
  d.budget_level = below;
  const auto at = static_cast<std::size_t>(below);
  d.score = 0.5 * (d.faults[0].detected[at] + d.faults[1].detected[at]);
  d.mean_delay = delay;
  return d;
}

class DetectorPage : public ::testing::Test {
 protected:
  DetectorPage() {
    study_.name = "two detectors";
    study_.fingerprint = "abcd";
    study_.trial.window = 0.01;
    study_.budget = 1e-4;
  }
  std::string Page() const {
    return testing::Written(
        [&](const std::string& path) { WriteDetectorReport(study_, curves_, {}, path); });
  }

  DetectorStudy study_;
  // "slope" has false alarms up to level 200 and finds an open coil there, no short; "ripple" both.
  std::vector<DetectorCurves> curves_ = {Curves("slope", 200, 220, 3e-4),
                                         Curves("ripple", 150, 220, 5e-4)};
};

TEST_F(DetectorPage, TheBestAtEqualFalseAlarmsComesFirst) {
  ASSERT_EQ(curves_[0].score, 0.625);
  ASSERT_EQ(curves_[1].score, 1);
  const std::string words = testing::Words(Page());
  EXPECT_THAT(words, HasSubstr("ripple, 100 % of the faults found."));
  EXPECT_THAT(words, HasSubstr("study of 2 detectors"));
  EXPECT_THAT(words, HasSubstr("At equal false alarms"));
  const std::size_t table = words.find("\nfault\nruns\n");
  ASSERT_NE(table, std::string::npos);
  EXPECT_EQ(words.compare(table, 25, "\nfault\nruns\nripple\nslope\n"), 0)
      << words.substr(table, 40);
  EXPECT_THAT(words, HasSubstr("25.0 %"));  // the share of shorts that slope finds
  EXPECT_THAT(words, HasSubstr("100 %, 500"));
  EXPECT_THAT(words, HasSubstr("(87.5 %)"));  // named less often than found
}

TEST_F(DetectorPage, OnlyDetectorsWithAThresholdOfTheirSourceAreHeldToIt) {
  const std::string page = Page(), words = testing::Words(page);
  const std::string own = words.substr(words.rfind("thresholds of the sources"));
  EXPECT_THAT(own, HasSubstr("slope\n2 A\n"));
  EXPECT_THAT(own, Not(HasSubstr("ripple\n")));
  EXPECT_THAT(own, HasSubstr("50.0 % of 4000"));  // level of 2 A lies below 200
  EXPECT_THAT(page, HasSubstr("idle &amp; warm"));
  EXPECT_EQ(CountOf(page, "<figure id="), 3u);  // ROC, areas, delays
}

// Of a study over plants: every one counts once, at the thresholds of the sources.
TEST_F(DetectorPage, HealthyPlantsWithAnAlarm) {
  EXPECT_THAT(Page(), Not(HasSubstr("Healthy plants with an alarm")));
  for (DetectorCurves& d : curves_) {
    d.all.plants = 36;
    d.all.alarmed.assign(kStatisticLevels, 3);
  }
  const std::string words = testing::Words(Page());
  EXPECT_THAT(words, HasSubstr("slope alarms on the fewest healthy plants, 3 of 36"));
  EXPECT_THAT(words, HasSubstr("Healthy plants with an alarm"));
  EXPECT_THAT(words, HasSubstr("slope\n2 A\n3 of 36\n"));
}

// A threshold is a number of its unit; where the unit is a source's own size, a multiple of it.
TEST_F(DetectorPage, ThresholdsHaveTheirUnits) {
  curves_[0].unit = "700 A/s";
  EXPECT_THAT(testing::Words(Page()), HasSubstr("slope\n2 × 700 A/s\n"));
  curves_[0].unit = "-";
  EXPECT_THAT(testing::Words(Page()), HasSubstr("slope\n2\n"));
}

TEST_F(DetectorPage, ABrowserDrawsEveryFigure) {
  if (!testing::HasBrowser()) GTEST_SKIP() << "no chromium";
  const testing::TemporaryFolder folder;
  WriteDetectorReport(study_, curves_, {}, folder.File("d.html"));
  const testing::BuiltPage built = testing::BuildInBrowser(folder.File("d.html"));
  EXPECT_EQ(built.exit_code, 0);
  EXPECT_TRUE(built.clean()) << built.console;
  EXPECT_EQ(built.figures(), 3u);
}

TEST_F(DetectorPage, NothingDoneIsSaid) {
  for (DetectorCurves& d : curves_) d.faults.clear();
  const std::string page = Page();
  EXPECT_THAT(page, HasSubstr("there is nothing to compare"));
  EXPECT_EQ(CountOf(page, "<figure id="), 0u);
  EXPECT_THAT(DetectorText(study_, curves_, {}), HasSubstr("nothing to compare"));
}

TEST_F(DetectorPage, TextHasOneLineADetectorAtBothThresholds) {
  const std::string text = DetectorText(study_, curves_, {});
  EXPECT_THAT(text, HasSubstr("[1] open (8 runs)"));
  EXPECT_THAT(text, HasSubstr("[2] partial-short fraction=0.1 (8 runs)"));
  EXPECT_EQ(CountOf(text, "\n  ripple "), 1u);  // no threshold of its source
  EXPECT_EQ(CountOf(text, "\n  slope "), 2u);
  EXPECT_THAT(text, HasSubstr("100.0 %  500 us"));
  EXPECT_THAT(text, HasSubstr("25.0 %       -"));
  EXPECT_LT(text.find("\n  ripple "), text.find("\n  slope "));
}

TEST_F(DetectorPage, JsonHoldsCurvesWhereTheyChange) {
  const auto json = DetectorJson(study_, curves_, {});
  EXPECT_EQ(json["name"], "two detectors");
  EXPECT_EQ(json["windows"], 4000);
  ASSERT_EQ(json["detectors"].size(), 2u);
  const auto& slope = json["detectors"][1];
  EXPECT_EQ(slope["name"], "slope");
  EXPECT_EQ(slope["documented_threshold"], 2.0);
  EXPECT_TRUE(json["detectors"][0]["documented_threshold"].is_null());
  EXPECT_DOUBLE_EQ(slope["threshold"].get<double>(), ValueOf(200));
  EXPECT_EQ(slope["faults"][0]["detected"], 1.0);
  EXPECT_TRUE(slope["faults"][1]["median_delay"].is_null());
  EXPECT_EQ(slope["healthy"][0]["scenario"], "idle & warm");
  // Level 0, the three levels at which something changes, the last.
  ASSERT_EQ(slope["curve"].size(), 5u);
  EXPECT_EQ(slope["curve"][0]["false_alarms"], 0.5);
  EXPECT_DOUBLE_EQ(slope["curve"][1]["threshold"].get<double>(), ValueOf(181));
  EXPECT_DOUBLE_EQ(slope["curve"][2]["threshold"].get<double>(), ValueOf(200));
  EXPECT_EQ(slope["curve"][2]["false_alarms"], 0);
  EXPECT_DOUBLE_EQ(slope["curve"][4]["threshold"].get<double>(), ValueOf(kStatisticLevels - 1));
}

}  // namespace
}  // namespace ambrig
