// The card of the next record as page and JSON, from a plan that is written down.
#include <gmock/gmock.h>

#include "app/json/plan_json.h"
#include "app/pages/plan_report.h"
#include "tests/app/html_page.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

Plan TwoNames() {
  Plan p;
  p.names = {"eddy-currents at A", "nothing"};
  p.separates = {{"eddy-currents at A", "nothing", 6.25, 0.9991, 30, 30}};
  p.tried = {{"current pulses", 0.5, 0, "", 0, 6.25, ""},
             {"multisine <levitated>", 0.25, 4.2e-5, "A", 0.42, 3.1, ""},
             {"run-up", 1, 1.9e-4, "A", 1.9, 0, "largest orbit 190 um, allowed 100 um"}};
  p.title = "current pulses";
  p.toml = "name = \"pulses\"  # <TOML> & text\n";
  p.text = "# The card\nHold the rotor and pulse coil 1.\n";
  p.duration = 0.4;
  p.record_rate = 450000;
  p.largest_orbit = 0;
  p.largest_current = 4.5;
  p.channels = {"A.i1", "A.d1"};
  p.runs = 123;
  return p;
}

std::string PlanPage(const Plan& p) {
  return testing::Written(
      [&](const std::string& path) { WritePlanReport(p, "case.toml", "next.toml", path); });
}

TEST(PlanPage, HasCardComparisonAndFile) {
  const std::string html = PlanPage(TwoNames()), words = testing::Words(html);
  for (const char* head : {"The next record", "Card", "Scenarios compared", "Scenario file"})
    EXPECT_THAT(words, HasSubstr(head));
  EXPECT_THAT(words, HasSubstr("Hold the rotor and pulse coil 1."));
  EXPECT_THAT(words, HasSubstr("at least 99.9 %"));
  EXPECT_THAT(words, HasSubstr("next.toml"));
  EXPECT_THAT(html, HasSubstr("# &lt;TOML&gt; &amp; text"));
  EXPECT_THAT(words, HasSubstr("\neddy-currents at A\nnothing\n6.2\n99.9 %\n30 of 30\n"));
}

// Names of scenarios are long: they stand whole beside lying bars.
TEST(PlanPage, TheNamesBesideTheBarsAreNotCut) {
  const std::string html = PlanPage(TwoNames());
  EXPECT_THAT(html, HasSubstr("\"orientation\":\"h\""));
  EXPECT_THAT(html, HasSubstr("\"automargin\":true"));
}

// Scenarios that were refused stand in the table with their reason, without a bar.
TEST(PlanPage, WhatWasRefusedIsSaidWithItsReason) {
  const std::string html = PlanPage(TwoNames()), words = testing::Words(html);
  EXPECT_THAT(words,
              HasSubstr("\nrun-up\n1\n-\n190.0 at A\nlargest orbit 190 um, allowed 100 um\n"));
  EXPECT_THAT(words, HasSubstr("\ncurrent pulses\n0.5\n6.2\n-\nyes\n"));
  const auto bars = html.find("\"current pulses\"");
  ASSERT_NE(bars, std::string::npos);
  EXPECT_EQ(html.find("\"run-up\""), std::string::npos);
}

// The colour of the verdict follows the least certain pair.
TEST(PlanPage, TheLeastCertainPairDecides) {
  const auto verdict = [](double probability) {
    Plan p = TwoNames();
    p.separates.push_back({"saturation at A", "nothing", 2, probability, 20, 30});
    return PlanPage(p);
  };
  EXPECT_THAT(testing::Words(verdict(0.95)), HasSubstr("at least 95.0 %"));
  EXPECT_THAT(testing::Words(verdict(0.6)), HasSubstr("at least 60.0 %"));
  EXPECT_EQ(testing::CountOf(verdict(0.6), "class=\"verdict warn\""), 2u);  // one if no JavaScript
  EXPECT_THAT(verdict(0.95), HasSubstr("class=\"verdict info\""));
  EXPECT_THAT(verdict(0.995), HasSubstr("class=\"verdict ok\""));
}

TEST(PlanPage, WarningsAreShown) {
  Plan p = TwoNames();
  p.warnings = {"saturation at A cannot be told from nothing by any scenario"};
  EXPECT_THAT(testing::Words(PlanPage(p)), HasSubstr("cannot be told from nothing"));
  EXPECT_EQ(testing::CountOf(PlanPage(TwoNames()), "verdict warn"), 1u);  // that of no JavaScript
}

// Keys of docs/guide/files.md, and numbers as they are.
TEST(PlanJson, HoldsWhatTheDocsName) {
  const auto j = PlanJson(TwoNames(), "next.toml");
  EXPECT_EQ(j["scenario"], "next.toml");
  EXPECT_EQ(j["separates"][0]["a"], "eddy-currents at A");
  EXPECT_EQ(j["separates"][0]["b"], "nothing");
  EXPECT_EQ(j["separates"][0]["probability"], 0.9991);
  EXPECT_EQ(j["separates"][0]["distance"], 6.25);
  EXPECT_EQ(j["separates"][0]["right"], 30);
  EXPECT_EQ(j["separates"][0]["draws"], 30);
  EXPECT_EQ(j["largest_orbit"], 0);
  EXPECT_EQ(j["duration"], 0.4);
  EXPECT_EQ(j["text"], TwoNames().text);
  ASSERT_EQ(j["tried"].size(), 3u);
  EXPECT_EQ(j["tried"][2]["refused"], "largest orbit 190 um, allowed 100 um");
  EXPECT_EQ(j["channels"][1], "A.d1");
  EXPECT_EQ(j["largest_current"], 4.5);
  EXPECT_EQ(j["record_rate"], 450000);
  EXPECT_EQ(j["runs"], 123);
}

}  // namespace
}  // namespace ambrig
