// The table "JSON of the commands" of docs/guide/files.md beside what the program writes: every key
// at the top of a document is named there, and what is named there is written.
#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "app/json/discovery_json.h"
#include "app/json/plan_json.h"
#include "app/json/refine_json.h"
#include "app/json/run_json.h"
#include "app/pages/paper_report.h"
#include "effects/catalogue.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// The words in backquotes of a command's row.
std::set<std::string> NamedKeys(const std::string& command) {
  const std::string page = ReadText(std::string(AMBRIG_SOURCE_DIR) + "/docs/guide/files.md");
  const auto table = page.find("## JSON of the commands");
  const auto begin = page.find("\n| `" + command + "` |", table);
  EXPECT_NE(begin, std::string::npos) << command;
  const std::string row = page.substr(begin + 1, page.find('\n', begin + 1) - begin - 1);
  const std::string keys = row.substr(row.find('|', 2) + 1);
  std::set<std::string> out;
  const std::regex word("`([a-zA-Z_0-9]+)`");
  for (std::sregex_iterator it(keys.begin(), keys.end(), word), end; it != end; ++it)
    out.insert((*it)[1]);
  return out;
}

void CollectKeys(const OrderedJson& j, std::set<std::string>* out) {
  if (j.is_object())
    for (const auto& [key, value] : j.items()) {
      out->insert(key);
      CollectKeys(value, out);
    }
  if (j.is_array())
    for (const OrderedJson& value : j) CollectKeys(value, out);
}

/// `absent`: named keys that stand only in some documents.
void ExpectDocumented(const std::string& command, const OrderedJson& document,
                      const std::set<std::string>& absent = {}) {
  const std::set<std::string> named = NamedKeys(command);
  for (const auto& [key, value] : document.items())
    EXPECT_TRUE(named.contains(key) || key == "made_by" || key == "provenance")
        << command << " writes " << key;
  std::set<std::string> written;
  CollectKeys(document, &written);
  for (const std::string& key : named)
    EXPECT_TRUE(written.contains(key) || absent.contains(key))
        << command << " never writes " << key;
}

TEST(JsonDocs, Paper) {
  PaperStudy study;
  study.converters.resize(1);
  ExpectDocumented("paper", PaperJson(study));
}

TEST(JsonDocs, Run) {
  RunResult r;
  RunEvent e;
  e.kind = "classified";
  e.target = "A.coil1";
  e.fault_class = "partial-short";
  e.fraction = 0.5;
  r.events = {e, {0.3, "model_invalid", "A", "", 0}};
  r.actions = {{0.1, "A.coil1", "disable", "open"}};
  Scenario s;
  s.name = "t";
  OrderedJson json = RunJson(s, r, {});
  json["bending_modes"] = DroppedModesJson({2, 1, 90, {120}, {{"A", 1e-8, 1e-9, 2e-9}}, {700}});
  ExpectDocumented("run", json);
}

TEST(JsonDocs, Compare) {
  Comparison c;
  RecordComparison r;
  r.channels = {{"A.x", 0.1, 1e-6, 2e-7, 5, 0.3}};
  r.blocks = {{"rotor", 2}};
  c.records = {r};
  ExpectDocumented("compare", CompareJson(c));
}

TEST(JsonDocs, Explain) {
  Explanation e;
  e.verdict = ExplanationVerdict::kUnknown;
  e.final_fit.hypothesis.free = {
      {.path = "bearings.A.gap", .value = 4.1e-4, .start = 4e-4, .sd = 1e-5}};
  e.final_fit.sd = {4e-6};
  e.ranking.resize(1);
  e.ranking[0].shaped = StageRatios{1.01, 1.02, 1.03};
  ExpectDocumented("explain", ExplainJson(e), {"mend"});
}

TEST(JsonDocs, Plan) {
  Plan p;
  p.separates = {{"a", "b", 1, 0.9, 9, 10}};
  ExpectDocumented("plan", PlanJson(p, "next.toml"));
}

TEST(JsonDocs, Refine) {
  Refinement r;
  r.curve = {{0.1, 1, 0.2, 0.9, 0.8, true}};
  r.fit.fit.hypothesis.rig.effects = {MakeInstance(EffectNamed("bh-curve"), "A")};
  const OrderedJson j = RefineJson(r);
  ExpectDocumented("refine", j);
  EXPECT_EQ(j["curve"][0]["sd"], 0.2);
  EXPECT_EQ(j["curve"][0]["visited"], true);
  EXPECT_EQ(j["refined"]["effect"], "bh-curve");
}

class JsonDocsOf : public CliFolder {};

TEST_F(JsonDocsOf, Redistribute) {
  Write("rig.toml", ReferenceRigText());
  ASSERT_EQ(Ambrig("redistribute rig.toml --failed 3 --json out.json").exit, 0);
  ExpectDocumented("redistribute", OrderedJson::parse(ReadText(folder_ / "out.json")));
}

// No number is lost to a program that reads the file: infinity is a word, the unknown is null.
TEST(ComparisonJson, InfinitiesAreWords) {
  Comparison c;
  c.ratio = c.ratio_fit = std::numeric_limits<double>::infinity();
  c.ratio_validate = std::nan("");
  RecordComparison r;
  r.ratio = c.ratio;
  r.channels = {{"A.x", c.ratio, c.ratio, 1e-7, c.ratio, 0}};
  c.records = {r};
  const OrderedJson j = OrderedJson::parse(CompareJson(c).dump());
  EXPECT_EQ(j["ratio"], "inf");
  EXPECT_TRUE(j["ratio_validate"].is_null());
  EXPECT_EQ(j["records"][0]["ratio"], "inf");
  EXPECT_EQ(j["records"][0]["channels"]["A.x"]["rms_error"], "inf");
  EXPECT_EQ(j["records"][0]["channels"]["A.x"]["noise"], 1e-7);
}

}  // namespace
}  // namespace ambrig
