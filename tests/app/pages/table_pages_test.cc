// Pages of campaigns and of crosschecks from rows and runs written by hand: what a reader is told,
// and that a browser builds every figure.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "app/pages/campaign_report.h"
#include "app/pages/crosscheck_report.h"
#include "app/pages/html.h"
#include "tests/app/browser.h"
#include "tests/campaign/table_rows.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::RowOf;
using testing::TemporaryFolder;

/// One open coil at two loads: held, touched, dropped; and the same run at the lower load again.
Rows FourRuns() {
  const auto with = [](std::size_t run, const char* load, const char* verdict, const char* orbit,
                       const char* delay, const char* detected) {
    return RowOf(run, {{"set", "A:3"},
                       {"failed", "1"},
                       {"class", "exact"},
                       {"kind", "open"},
                       {"speed", "157.07963267948966"},
                       {"load_given", load},
                       {"load", load},
                       {"capacity", "32"},
                       {"verdict", verdict},
                       {"judged", "1"},
                       {"detected", detected},
                       {"right_class", detected},
                       {"detection_delay", delay},
                       {"false_alarms", "0"},
                       {"coil_periods", "1000"},
                       {"peak_orbit", orbit}});
  };
  return {{0, with(0, "10", "up", "2e-05", "0.0001", "1")},
          {1, with(1, "10", "up", "5e-05", "0.0003", "1")},
          {2, with(2, "20", "drop", "0.0008", "", "0")},
          {3, with(3, "20", "touchdown", "0.00021", "0.0002", "1")}};
}

std::string TextOf(const testing::BuiltPage& p) {
  EXPECT_EQ(p.exit_code, 0);
  EXPECT_TRUE(p.clean()) << p.console;
  return p.dom;
}

TEST(CampaignPage, SaysWhatTheRowsSay) {
  if (!testing::HasBrowser()) GTEST_SKIP() << "no chromium";
  const TemporaryFolder folder;
  WriteCampaignReport({"four runs", "/files/c.toml", "1234", 4}, FourRuns(), folder.File("c.html"));
  const testing::BuiltPage built = testing::BuildInBrowser(folder.File("c.html"));
  const std::string dom = TextOf(built);
  EXPECT_EQ(built.figures(), 3U);  // one survival map, one histogram, capacity
  EXPECT_THAT(dom, HasSubstr("2 of 4 runs stayed up, 1 touched down, 1 dropped."));
  EXPECT_THAT(dom, HasSubstr("0 in 4e+03 switching periods of healthy coils"));
  EXPECT_THAT(dom, HasSubstr("Survival: open, 1500"));
  for (const char* value : {">50&nbsp;µm<", "300&nbsp;µs", "800&nbsp;µm", "210&nbsp;µm"})
    EXPECT_THAT(dom, HasSubstr(value));
  // least, median, 95 %, greatest of 100, 200, 300 µs
  EXPECT_THAT(dom, ::testing::ContainsRegex("open</td>.*3</td>.*100.0</td>.*200.0</td>"));
}

// Worst first: the drop, the touchdown, then by orbit; each with the command that repeats it.
TEST(CampaignPage, WorstRunsComeFirstWithTheirCommand) {
  const TemporaryFolder folder;
  WriteCampaignReport({"four runs", "/files/c.toml", "1234", 4}, FourRuns(), folder.File("c.html"));
  std::ifstream in(folder.File("c.html"));
  const std::string html{std::istreambuf_iterator<char>(in), {}};
  std::size_t at = 0;
  for (const int run : {2, 3, 1, 0}) {
    const std::size_t next = html.find(
        "ambrig run --from-campaign /files/c.toml --row " + std::to_string(run) + "<", at);
    ASSERT_NE(next, std::string::npos) << run;
    at = next;
  }
}

TEST(CampaignPage, NoRowsNoFigures) {
  const TemporaryFolder folder;
  WriteCampaignReport({"nothing yet", "/files/c.toml", "1234", 4}, {}, folder.File("c.html"));
  std::ifstream in(folder.File("c.html"));
  const std::string html{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(html, HasSubstr("0 of 0 runs stayed up"));
  EXPECT_THAT(html, Not(HasSubstr("<figure id=")));
}

// The line that the text speaks of is drawn: what is held as theory says.
TEST(CampaignPage, CapacityHasItsLine) {
  const TemporaryFolder folder;
  WriteCampaignReport({"four runs", "/files/c.toml", "1234", 4}, FourRuns(), folder.File("c.html"));
  std::ifstream in(folder.File("c.html"));
  const std::string html{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(html, HasSubstr("\"name\":\"held = theory\""));
  EXPECT_THAT(html, HasSubstr("below the dashed line"));
}

// At 1300 px: a table of fourteen columns fits, one of sixty says that it does not.
TEST(WidePages, TablesFitOrSayThatTheyDoNot) {
  if (!testing::HasBrowser()) GTEST_SKIP() << "no chromium";
  const TemporaryFolder folder;
  const auto page = [&](std::size_t columns) {
    HtmlReport report("wide", "test");
    const std::vector<Cell> row(columns, Cell("100 %, 45.3\u00a0µs (98 %)"));
    report.Table(std::vector<std::string>(columns, "current-sensor, gain 0.8"), {row, row});
    const std::string file = folder.File(std::to_string(columns) + ".html");
    report.Write(file);
    return testing::BuildInBrowser(file);
  };
  EXPECT_EQ(page(14).Count("wide scrolls\""), 0U);
  EXPECT_EQ(page(60).Count("wide scrolls\""), 1U);
}

/// A centre on a circle of the radius given from 20 ms on, at rest in the middle before.
CrosscheckRun RunOf(double radius, bool drop) {
  CrosscheckRun run;
  run.figures.touchdown = true;
  run.figures.drop = drop;
  run.figures.first = "A";
  run.figures.touchdown_time = 0.02;
  run.figures.rebound = 1.5e-4;
  run.figures.peak_orbit = radius;
  run.figures.turns = drop ? -12.5 : 0.2;
  run.figures.whirl = drop ? ContactWhirl::kBackward : ContactWhirl::kNone;
  run.figures.rest = {{-2e-7, -2e-4}};  // -0.2 µm is 0, not -0
  run.figures.severity = 2.5;
  run.figures.fall_severity = 1.25;
  run.paths.rate = 10000;
  CentrePath path;
  path.bearing = "A";
  path.clearance = 2e-4;
  for (int k = 0; k < 1000; ++k) {
    const double r = k < 200 ? 0 : radius;
    path.x.push_back(r * std::cos(0.1 * k));
    path.y.push_back(r * std::sin(0.1 * k));
    run.paths.Omega.push_back(157);
  }
  run.paths.bearings = {path};
  return run;
}

CrosscheckedScenario ScenarioOf(bool model_drops, bool ode_drops) {
  CrosscheckedScenario s;
  s.file = "library/drop.toml";
  s.name = "drop at <1500> rpm";
  s.crosscheck.model = RunOf(2.2e-4, model_drops);
  s.crosscheck.other_noise = RunOf(2.21e-4, model_drops);
  s.crosscheck.ode = RunOf(2.3e-4, ode_drops);
  s.crosscheck.parted_ode = 0.0892;
  return s;
}

TEST(CrosscheckPage, ShowsBothModelsAndTheirVerdicts) {
  if (!testing::HasBrowser()) GTEST_SKIP() << "no chromium";
  const TemporaryFolder folder;
  WriteCrosscheckReport({ScenarioOf(true, true), ScenarioOf(true, false)}, folder.File("w.html"));
  const testing::BuiltPage built = testing::BuildInBrowser(folder.File("w.html"));
  const std::string dom = TextOf(built);
  EXPECT_EQ(built.figures(), 4U);  // orbits and radii of either scenario
  EXPECT_THAT(dom, HasSubstr("Both models agree: dropped."));
  EXPECT_THAT(dom, HasSubstr("The compliant model says dropped, the one on ODE touched down."));
  EXPECT_EQ(built.Count("✓ agree"), 1U);
  EXPECT_EQ(built.Count("✗ differ"), 1U);
  EXPECT_THAT(dom, HasSubstr("drop at &lt;1500&gt; rpm"));
  for (const char* value : {">20.000<", ">150.0<", ">220.0<", ">230.0<", ">2.5000<", ">1.25<",
                            ">89.2<", "backward (-12.5)", "A (0, -200)"})
    EXPECT_THAT(dom, HasSubstr(value));
}

TEST(CrosscheckPage, AScenarioWithoutContactIsARowOnly) {
  CrosscheckedScenario s = ScenarioOf(false, false);
  for (CrosscheckRun* run : {&s.crosscheck.model, &s.crosscheck.ode}) {
    run->figures.first.clear();
    run->figures.touchdown = false;
  }
  const TemporaryFolder folder;
  WriteCrosscheckReport({s}, folder.File("w.html"));
  std::ifstream in(folder.File("w.html"));
  const std::string html{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(html, HasSubstr("stayed up"));
  EXPECT_THAT(html, HasSubstr("1 scenario<"));
  EXPECT_THAT(html, Not(HasSubstr("<figure id=")));
}

TEST(CrosscheckJson, HoldsTheFiguresAndNullWhereTheyNeverHappened) {
  const nlohmann::ordered_json j = CrosscheckJson(ScenarioOf(true, false));
  EXPECT_EQ(j.at("verdicts_agree"), false);
  EXPECT_EQ(j.at("whirl_agrees"), false);
  EXPECT_EQ(j.at("parted_ode"), 0.0892);
  EXPECT_TRUE(j.at("parted_other_noise").is_null());
  EXPECT_EQ(j.at("compliant").at("verdict"), "dropped");
  EXPECT_EQ(j.at("ode").at("verdict"), "touched down");
  EXPECT_EQ(j.at("ode").at("peak_orbit"), 2.3e-4);
  EXPECT_EQ(j.at("compliant").at("rest").at("A")[1], -2e-4);
}

}  // namespace
}  // namespace ambrig
