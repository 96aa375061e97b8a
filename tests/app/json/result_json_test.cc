// What programs read: JSON of runs, comparisons, explanations and analyses, from results written by
// hand.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "app/json/discovery_json.h"
#include "app/json/run_json.h"
#include "effects/catalogue.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> Keys(const nlohmann::ordered_json& j) {
  std::vector<std::string> out;
  for (const auto& [key, value] : j.items()) out.push_back(key);
  return out;
}

RunResult MadeRun() {
  RunResult r;
  RunEvent fault;
  fault.t = 0.1;
  fault.kind = "fault";
  fault.target = "A.coil3";
  RunEvent classified = fault;
  classified.t = 0.101;
  classified.kind = "classified";
  classified.fault_class = "partial-short";
  classified.fraction = 0.25;
  r.events = {fault, classified};
  r.metrics.max_orbit = {{"A", 3e-5}, {"B", 1e-5}};
  r.metrics.peak_current = 4.5;
  r.metrics.detection_delay = 2e-4;
  r.touchdown = true;
  r.doubtful = true;
  r.doubtful_share = {{"A", 0.25}, {"B", 0}};
  r.notes = {"one note"};
  return r;
}

TEST(RunJson, EventsCarryClassAndFractionOnlyWhereThereIsOne) {
  Scenario s;
  s.name = "short";
  s.seed = 42;
  const auto j = RunJson(s, MadeRun(), {});
  EXPECT_EQ(j["name"], "short");
  EXPECT_EQ(j["seed"], 42);
  EXPECT_THAT(Keys(j["events"][0]), ElementsAre("t", "kind", "target"));
  EXPECT_THAT(Keys(j["events"][1]), ElementsAre("t", "kind", "target", "class", "fraction"));
  EXPECT_EQ(j["events"][1]["fraction"], 0.25);
  EXPECT_EQ(j["touchdown"], true);
  EXPECT_EQ(j["drop"], false);
  EXPECT_EQ(j["fault_tolerance"]["doubtful"], true);
  EXPECT_EQ(j["fault_tolerance"]["doubtful_share"]["A"], 0.25);
  EXPECT_EQ(j["notes"][0], "one note");
}

// A delay that did not happen is null, not -1.
TEST(RunJson, WhatDidNotHappenIsNull) {
  const auto m = RunJson({}, MadeRun(), {})["metrics"];
  EXPECT_EQ(m["detection_delay"], 2e-4);
  EXPECT_TRUE(m["redistribution_delay"].is_null());
  EXPECT_EQ(m["max_orbit"]["B"], 1e-5);
  EXPECT_EQ(m["peak_current"], 4.5);
}

TEST(RunJson, ExpectationsSayWantedGotAndMet) {
  const auto j = RunJson({}, MadeRun(),
                         {{"touchdown", "false", "true", false}, {"drop", "false", "false", true}});
  EXPECT_THAT(Keys(j["expect"]), ElementsAre("touchdown", "drop"));
  EXPECT_EQ(j["expect"]["touchdown"]["wanted"], "false");
  EXPECT_EQ(j["expect"]["touchdown"]["got"], "true");
  EXPECT_EQ(j["expect"]["touchdown"]["met"], false);
  EXPECT_EQ(j["expect"]["drop"]["met"], true);
}

TEST(CompareJson, RecordsByChannelAndBlock) {
  Comparison c;
  RecordComparison r;
  r.data = "record-1.h5";
  r.scenario = "steps";
  r.validate = true;
  r.ratio = 3.5;
  r.channels = {{"A.x", 0.01, 3e-6, 1e-6, 3.0, 0.8}};
  r.blocks = {{"coil", 1.1}};
  c.records = {r};
  c.ratio = 3.25;
  c.words = {"A.x in record-1.h5"};
  c.noise.channels["A.x"].stated = 1e-6;
  DataFault f;
  f.fault = "unit";
  f.factor = 1000;
  f.probability = 0.99;
  c.data = {f};
  const auto j = CompareJson(c);
  EXPECT_EQ(j["records"][0]["use"], "validate");
  EXPECT_EQ(j["records"][0]["channels"]["A.x"]["whiteness"], 0.8);
  EXPECT_EQ(j["records"][0]["channels"]["A.x"]["rms_error"], 3e-6);
  EXPECT_EQ(j["records"][0]["blocks"]["coil"], 1.1);
  EXPECT_EQ(j["ratio"], 3.25);
  EXPECT_EQ(j["data"][0]["fault"], "unit");
  EXPECT_EQ(j["data"][0]["factor"], 1000);
  EXPECT_EQ(j["noise"]["A.x"]["stated"], 1e-6);
  EXPECT_TRUE(j["noise"]["A.x"]["estimated"].is_null());  // not estimated
}

class ExplainJsonTest : public ::testing::Test {
 protected:
  ExplainJsonTest() {
    EffectInstance eddy = MakeInstance(EffectNamed("eddy-currents"), "A");
    eddy.Set("cutoff", 3000);
    RankedEffect r;
    r.effect = eddy;
    r.probability = 0.9;
    r.fit.ratio_fit = 1.1;
    r.fit.ratio_validate = kInfinity;
    r.fit.converged = true;
    r.fit.warnings = {"correlated"};
    e_.ranking = {r};
    e_.adopted = {eddy};
    e_.set = {{"eddy-currents", "A", 0.9}, {"unknown", "", 0.1}};
    e_.closure = {0.95, 8, 1.2, 7, 1.1};
    e_.remainder = {RemainderKind::kLawVariation, {{"record-1.h5", "A.x", 1.4}}, "words"};
    e_.confusable = {{"eddy-currents", "hysteresis", "a burst"}};
    e_.ladder = {{"", 9, 8}, {"parameters", 8, 7}, {"eddy-currents at A", 1.2, 1.1}};
    e_.hidden = {{"side-pull", "B", "stiffness", "N/m", kInfinity}};
    e_.nuisances = {{"record-1.h5", "zero of A.x", "m", 2e-6, 1e-7}};
    Candidate c;
    c.effect = eddy;
    c.ratio_validate = 1.3;
    e_.screened.assign(30, c);
    e_.verdict = ExplanationVerdict::kEffect;
    e_.runs = 1234;
  }
  Explanation e_;
};

TEST_F(ExplainJsonTest, HoldsTheThreeAnswers) {
  const auto j = ExplainJson(e_);
  EXPECT_EQ(j["verdict"], "effect");
  EXPECT_EQ(j["set"][0]["effect"], "eddy-currents");
  EXPECT_EQ(j["set"][1]["probability"], 0.1);
  EXPECT_EQ(j["closure"]["explained"], 0.95);
  EXPECT_EQ(j["closure"]["test"]["after"], 1.1);
  EXPECT_EQ(j["remainder"]["kind"], "law-variation");
  EXPECT_EQ(j["remainder"]["where"][0]["ratio"], 1.4);
  EXPECT_THAT(j["confusable"][0], ElementsAre("eddy-currents", "hysteresis", "a burst"));
  EXPECT_EQ(j["ladder"].size(), 3u);
  EXPECT_EQ(j["ladder"][2]["added"], "eddy-currents at A");
  EXPECT_EQ(j["screened"].size(), 20u);  // no more than that
  EXPECT_EQ(j["simulated_records"], 1234);
  EXPECT_EQ(j["nuisances"][0]["name"], "zero of A.x");
  EXPECT_FALSE(j.contains("unexplained"));
}

TEST_F(ExplainJsonTest, SaysBesideWhatNamesWereJudgedAndWhatTheRigIs) {
  EffectInstance unbalance = MakeInstance(EffectNamed("unbalance"), "B");
  e_.adopted.push_back(unbalance);
  e_.judged_beside = {"unbalance at B"};
  e_.further_sets = {{"unbalance at B", {{"unbalance", "B", 0.97}}}};
  FreeParameter gap;
  gap.path = "bearings.A.gap";
  gap.value = 4.02e-4;
  gap.start = 4e-4;
  gap.sd = 4e-6;
  FreeParameter size;  // of an effect: stands with the effect
  size.effect = 0;
  e_.final_fit.hypothesis.free = {gap, size};
  e_.final_fit.sd = {1e-6, 1};
  const auto j = ExplainJson(e_);
  EXPECT_THAT(j["judged_beside"], ElementsAre("unbalance at B"));
  EXPECT_FALSE(j["adopted"][0].contains("set"));
  EXPECT_EQ(j["adopted"][1]["set"][0]["probability"], 0.97);
  ASSERT_EQ(j["parameters"].size(), 1u);
  EXPECT_EQ(j["parameters"][0]["path"], "bearings.A.gap");
  EXPECT_EQ(j["parameters"][0]["value"], 4.02e-4);
  EXPECT_EQ(j["parameters"][0]["sd"], 1e-6);
  EXPECT_EQ(j["parameters"][0]["drawing"], 4e-4);
  EXPECT_EQ(j["parameters"][0]["drawing_sd"], 4e-6);
}

// Infinities are words, so that every program can read the file.
TEST_F(ExplainJsonTest, IsValidJsonWhateverTheNumbers) {
  const auto j = ExplainJson(e_);
  EXPECT_EQ(j["ranking"][0]["ratio_validate"], "inf");
  EXPECT_EQ(j["hidden"][0]["size"], "inf");
  EXPECT_EQ(j["ranking"][0]["parameters"]["cutoff"]["value"], 3000);
  EXPECT_EQ(j["ranking"][0]["parameters"]["cutoff"]["unit"], "Hz");
  EXPECT_EQ(nlohmann::ordered_json::parse(j.dump()), j);
}

TEST_F(ExplainJsonTest, AnUnknownCauseIsDescribed) {
  e_.verdict = ExplanationVerdict::kUnknown;
  e_.unexplained = {"rotor or sensor", "plane B", "position (linear)", "text", "force", {120, 240}};
  const auto j = ExplainJson(e_);
  EXPECT_EQ(j["unexplained"]["where"], "plane B");
  EXPECT_THAT(j["unexplained"]["frequencies"], ElementsAre(120, 240));
  EXPECT_EQ(j["unexplained"]["formula"], "force");
}

}  // namespace
}  // namespace ambrig
