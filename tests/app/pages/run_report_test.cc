#include "app/pages/run_report.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <regex>
#include <set>

#include "app/figures/run_figures.h"
#include "core/base/errors.h"
#include "tests/app/browser.h"
#include "tests/app/demo_run.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class RunReport : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { html_ = new std::string(MakeRunReport(demo::Run()).Html()); }
  static void TearDownTestSuite() { delete html_; }
  static std::string* html_;
};
std::string* RunReport::html_ = nullptr;

std::size_t Count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

// Our own markup, without the two scripts' source (the library names addresses in comments).
std::string WithoutScripts(const std::string& html) {
  std::string out;
  std::size_t at = 0;
  for (std::size_t begin = html.find("<script>"); begin != std::string::npos;
       begin = html.find("<script>", at)) {
    out += html.substr(at, begin - at);
    at = html.find("</script>", begin);
  }
  return out + html.substr(at);
}

TEST_F(RunReport, LoadsNothingFromOutside) {
  const std::string own = WithoutScripts(*html_);
  EXPECT_THAT(own, Not(HasSubstr("http://")));
  EXPECT_THAT(own, Not(HasSubstr("https://")));
  EXPECT_THAT(own, Not(HasSubstr("@import")));
  EXPECT_THAT(own, Not(HasSubstr("<link")));
  EXPECT_THAT(own, Not(HasSubstr("src=")));
  EXPECT_THAT(own, HasSubstr("default-src 'none'"));
  EXPECT_THAT(*html_, HasSubstr("showSendToCloud: false"));
  const std::regex link("href=\"([^\"]*)\"");
  for (auto it = std::sregex_iterator(own.begin(), own.end(), link); it != std::sregex_iterator();
       ++it)
    EXPECT_EQ((*it)[1].str().front(), '#');
  EXPECT_GT(html_->size(), 1'000'000u) << "the plotting library is inside";
}

TEST_F(RunReport, HasEverySection) {
  for (const char* section :
       {"Course of the run", "Timeline", "Expectations", "Orbits", "Positions", "Coil currents",
        "Fault detection", "All coils", "Stator cross-sections", "Further channels",
        "Scenario and rig files"})
    EXPECT_EQ(Count(*html_, std::string(">") + section + "</h"), 1u) << section;
  EXPECT_EQ(Count(*html_, "<figure id="), 12u);
  EXPECT_EQ(Count(*html_, "<figcaption>"), 12u);
  EXPECT_THAT(*html_, HasSubstr("+400\u00a0µs"));
  EXPECT_THAT(*html_, HasSubstr("# a &lt; b &amp; c"));
}

// A "<" in data must not be able to end the data block.
TEST(RunReportEscapes, DataCannotLeaveItsScript) {
  RunReportData d = demo::Run();
  d.name = "</title><b>";
  d.channels[0].name = "</script><script>alert(1)</script>";
  const std::string html = MakeRunReport(d).Html();
  EXPECT_THAT(html, Not(HasSubstr("alert(1)</script>")));
  EXPECT_THAT(html, Not(HasSubstr("</title><b>")));
}

TEST(RunReportParts, EmptyRunGivesAReportWithoutFigures) {
  RunReportData d;
  d.name = "nothing";
  const std::string html = MakeRunReport(d).Html();
  EXPECT_EQ(Count(html, "<figure id="), 0u);
  EXPECT_THAT(html, HasSubstr("Course of the run"));
}

// Pages without a figure do not carry the library of 1 MB.
TEST(RunReportParts, NoPlotNoLibrary) {
  RunReportData d;
  d.name = "nothing";
  EXPECT_LT(MakeRunReport(d).Html().size(), 100'000u);
}

TEST(RunReportParts, EveryFaultyCoilIsBold) {
  RunReportData d = demo::Run();
  d.events.push_back({demo::kRedistributed + 1e-3, "fault", "B6", "open coil"});
  const Figure figure = CurrentFigure(d, FindStages(d), true);
  std::set<std::string> bold;
  for (const auto& trace : figure.traces)
    if (trace["line"]["width"] == 3) bold.insert(trace["name"].get<std::string>());
  EXPECT_EQ(bold, (std::set<std::string>{"A3 (faulty)", "B6 (faulty)"}));
}

// The disk of a flexible shaft moves more than the bearings.
TEST(RunReportParts, StationsHaveTheirOrbits) {
  RunReportData d = demo::Run();
  EXPECT_EQ(OrbitFigure(d, FindStages(d)).panels, 4);  // two bearings, and a close-up of each
  ReportStation disk{"disk", d.bearings[0].x, d.bearings[0].y};
  for (double& x : disk.x) x *= 30;
  d.stations = {disk};
  const Figure figure = OrbitFigure(d, FindStages(d));
  EXPECT_EQ(figure.panels, 3);
  EXPECT_EQ(figure.layout["annotations"][2]["text"], "<b>disk</b>");
}

// Hundreds of contacts: twenty rows stand open, and six lines cross the curves.
TEST(RunReportParts, ABouncingRotorDoesNotCoverTheReport) {
  RunReportData d = demo::Run();
  for (int k = 0; k < 260; ++k)
    d.events.push_back({1.01 + 1e-3 * k, k % 2 == 0 ? "touchdown" : "lift_off", "A", ""});
  const std::string html = MakeRunReport(d).Html();
  EXPECT_THAT(html, HasSubstr("244 more events</summary>"));
  EXPECT_EQ(EventMarks(d).size(), 10u);  // four of the fault, six contacts
}

TEST(RunReportParts, HealthyRunHasNoFaultFigures) {
  RunReportData d = demo::Run();
  d.events.clear();
  d.samples.clear();
  d.slopes.clear();
  const std::string html = MakeRunReport(d).Html();
  EXPECT_THAT(html, Not(HasSubstr("Fault detection</h2>")));
  EXPECT_THAT(html, Not(HasSubstr("after the fault")));
}

TEST(RunReportParts, UnwritablePathIsOneLineAndLeavesNothing) {
  const fs::path folder = fs::path(::testing::TempDir()) / "report_taken";
  fs::create_directories(folder);
  try {
    WriteRunReport(RunReportData{}, folder);
    FAIL() << "a folder is not a file";
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()), "cannot write " + folder.string() + ": Is a directory");
  }
  EXPECT_TRUE(fs::is_empty(folder));
}

// The page as a browser builds it: every figure drawn, no error on the console.
TEST_F(RunReport, DrawsEveryFigureInABrowser) {
  if (!testing::HasBrowser()) GTEST_SKIP() << "no chromium";
  const testing::TemporaryFolder folder;
  WriteRunReport(demo::Run(), folder.File("run.html"));
  const testing::BuiltPage built = testing::BuildInBrowser(folder.File("run.html"));
  ASSERT_EQ(built.exit_code, 0);
  EXPECT_EQ(built.figures(), 12u);
  EXPECT_THAT(built.dom, Not(::testing::ContainsRegex("data-title=\"[^\"]*([Cc]loud|[Ss]hare)")));
  EXPECT_TRUE(built.clean()) << built.console;
}

}  // namespace
}  // namespace ambrig
