// The page of a design study from points written by hand.
#include <gmock/gmock.h>

#include "app/pages/design_report.h"
#include "tests/app/browser.h"
#include "tests/app/html_page.h"

namespace ambrig {
namespace {

using testing::CountOf;
using ::testing::HasSubstr;
using ::testing::Not;

const FigureInfo* InfoOf(FigureKind kind) {
  for (const FigureInfo& f : FigureInfos())
    if (f.kind == kind) return &f;
  return nullptr;
}

class DesignPage : public ::testing::Test {
 protected:
  DesignPage() {
    study_.name = "pid & notch";
    study_.file = "study.toml";
    study_.fingerprint = "77";
    DesignVariable kp;
    kp.paths = {"controller.kp"};
    study_.candidates = {{"pid", "rig.toml", "", {kp}}, {"notch", "rig.toml", "", {}}};
    study_.scenarios = {{"load step", "step.toml", ""}};
    study_.figures = {{"peak sensitivity", InfoOf(FigureKind::kPeakSensitivity), 0, "", true, 3.0},
                      {"load step: orbit", InfoOf(FigureKind::kOrbit), 0, "", true, {}},
                      {"noise force", InfoOf(FigureKind::kNoiseForce), 0, "", false, {}}};
    Add(0, {4e5}, {2.5, 3e-5, 1.0}, true, true);
    Add(0, {5e5}, {2.0, 4e-5, 2.0}, true, true);
    Add(0, {6e5}, {3.5, 2e-5, 3.0}, false, false);
    Add(1, {}, {2.6, 3.5e-5, 1.5}, true, false);
  }
  void Add(std::size_t candidate, std::vector<double> values, std::vector<double> figures,
           bool feasible, bool front) {
    StudyPoint p;
    p.candidate = candidate;
    p.values = std::move(values);
    p.result.figures = std::move(figures);
    p.feasible = feasible;
    p.front = front;
    result_.points.push_back(p);
  }
  /// Points 0 and 3 with a step response and an orbit.
  std::vector<PointResponses> Shown() const {
    std::vector<PointResponses> shown(2);
    for (std::size_t c = 0; c < 2; ++c) {
      shown[c].point = 3 * c;
      shown[c].step_t = {0, 1e-3, 2e-3};
      shown[c].step = {0, 1e-6, 2e-6};
      shown[c].hertz = {1, 10, 100};
      shown[c].sensitivity = {0.1, 1.2, 2.5};
      ScenarioTrace trace;
      trace.t = {0, 0.01, 0.02};
      trace.orbit = {0, 1e-5, 3e-5};
      trace.planes = {{"disk", {0, 1e-5, 2e-5}}};
      shown[c].scenarios.push_back(trace);
    }
    return shown;
  }
  std::string Page() const {
    return testing::Written(
        [&](const std::string& path) { WriteDesignReport(study_, result_, Shown(), path); });
  }
  Study study_;
  StudyResult result_;
};

TEST_F(DesignPage, CountsPointsAndShowsOneOfEachCandidate) {
  const std::string page = Page(), words = testing::Words(page);
  EXPECT_THAT(words, HasSubstr("3 of 4 points are feasible, 2 are Pareto-optimal."));
  EXPECT_THAT(page, HasSubstr("pid &amp; notch"));
  EXPECT_THAT(words, HasSubstr("peak sensitivity (at most 3)"));
  // a column a candidate: pid, then notch
  EXPECT_THAT(words, HasSubstr("\nfigure\npid\nnotch\n"));
  EXPECT_THAT(words, HasSubstr("\npoints\n3\n1\n"));
  EXPECT_THAT(words, HasSubstr("\nmeet limits\n2\n1\n"));
  EXPECT_THAT(words, HasSubstr("\non the front\n2\n0\n"));
  EXPECT_THAT(words, HasSubstr("\npoint shown\n0\n3\n"));
  EXPECT_THAT(words, HasSubstr("\nas in its file\n"));
  EXPECT_THAT(words, HasSubstr("\npeak sensitivity (at most 3)\n2.5\n2.6\n"));
  EXPECT_THAT(words, Not(HasSubstr("draws of its parameters")));
}

TEST_F(DesignPage, EveryPointOfTheFrontCanBeRepeated) {
  const std::string words = testing::Words(Page());
  EXPECT_THAT(words, HasSubstr("ambrig design study.toml --point N\n"));
  EXPECT_THAT(words, HasSubstr("\n0\npid\n"));
  EXPECT_THAT(words, HasSubstr("\n1\npid\n"));
  EXPECT_THAT(words, Not(HasSubstr("\n2\npid\n")));
  EXPECT_THAT(words, Not(HasSubstr("\n3\nnotch\n")));
}

// Scatter, parallel coordinates, linear loop, orbit and the disk.
TEST_F(DesignPage, ABrowserDrawsEveryFigure) {
  EXPECT_EQ(CountOf(Page(), "<figure id="), 5u);
  if (!testing::HasBrowser()) GTEST_SKIP() << "no chromium";
  const testing::TemporaryFolder folder;
  WriteDesignReport(study_, result_, Shown(), folder.File("d.html"));
  const testing::BuiltPage built = testing::BuildInBrowser(folder.File("d.html"));
  EXPECT_EQ(built.exit_code, 0);
  EXPECT_TRUE(built.clean()) << built.console;
  EXPECT_EQ(built.figures(), 5u);
}

TEST_F(DesignPage, AStudyWithoutFeasiblePointsFails) {
  for (StudyPoint& p : result_.points) p.feasible = p.front = false;
  result_.points[3].result.figures = {kInfinity, kInfinity, kInfinity};
  const std::string page = Page(), words = testing::Words(page);
  EXPECT_THAT(words, HasSubstr("None of 4 points is feasible."));
  EXPECT_THAT(words, HasSubstr("unstable"));
  EXPECT_EQ(CountOf(page, "<figure id="), 3u);  // the responses stay
  EXPECT_THAT(words, Not(HasSubstr("Pareto-optimal points")));
}

TEST_F(DesignPage, DrawsOfTheParametersAreCounted) {
  study_.draws.resize(5);
  EXPECT_THAT(testing::Words(Page()), HasSubstr("4 draws of its parameters."));
}

}  // namespace
}  // namespace ambrig
