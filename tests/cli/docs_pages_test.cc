// The pages about records, cases and formulas name what the program's own tables have.
#include "core/base/toml.h"
#include "core/record/channels.h"
#include "core/record/time_base.h"
#include "core/record/units.h"
#include "effects/formula.h"
#include "effects/formula_parser.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

std::string Page(const std::string& name) {
  return ReadText(std::string(AMBRIG_SOURCE_DIR) + "/docs/guide/" + name);
}

bool Says(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

TEST(ChannelNamesPage, NamesEveryKindOfChannel) {
  const std::string page = Page("channel_names.md");
  for (const ChannelRow& row : kChannels) {
    ChannelId id{row.kind, row.scope == ChannelScope::kRig ? "" : "A", 0};
    EXPECT_TRUE(Says(page, "`" + id.name() + "`")) << id.name();
  }
}

/// Every unit that a channel may come in stands in the page, and the program takes it.
TEST(ChannelNamesPage, UnitsAreTaken) {
  const std::string page = Page("channel_names.md");
  const std::pair<const char*, const char*> rows[] = {{"| length | ", "m"},  {"| force | ", "N"},
                                                      {"| current | ", "A"}, {"| voltage | ", "V"},
                                                      {"| angle | ", "rad"}, {"| time | ", "s"}};
  for (const auto& [head, si] : rows) {
    const auto at = page.rfind(head);  // the table of units comes last
    ASSERT_NE(at, std::string::npos) << head;
    std::istringstream units(
        page.substr(at + std::string(head).size(), page.find(" |", at + 20) - at));
    std::string listed;
    std::getline(units, listed, '|');
    std::istringstream words(listed);
    int count = 0;
    for (std::string unit; std::getline(words, unit, ','); ++count) {
      unit.erase(0, unit.find_first_not_of(' '));
      unit.erase(unit.find_last_not_of(' ') + 1);
      EXPECT_NO_THROW(UnitFactor(unit, si, "")) << unit;
    }
    EXPECT_GE(count, 3) << head;
    try {  // the message lists all that exist
      UnitFactor("furlong", si, "");
    } catch (const InputError& e) {
      const std::string all = e.what();
      std::istringstream known(all.substr(all.find("allowed ") + 8));
      for (std::string unit; std::getline(known, unit, ',');)
        EXPECT_TRUE(Says(listed, unit.substr(unit.find_first_not_of(' ')))) << head << unit;
    }
  }
}

TEST(RecordsPage, TimeHeadersAreTaken) {
  const std::string page = Page("records.md");
  for (const char* name : {"t", "t_ms", "Time (s)", "time_us"}) {
    EXPECT_TRUE(Says(page, std::string("`") + name + "`")) << name;
    EXPECT_TRUE(IsTimeName(name)) << name;
  }
}

TEST(FormulasPage, NamesFunctionsAndVariables) {
  const std::string page = Page("formulas.md");
  std::istringstream functions(FormulaFunctions());
  for (std::string f; std::getline(functions, f, ',');)
    EXPECT_TRUE(Says(page, f.substr(f.find_first_not_of(' ')))) << f;
  for (const FormulaTarget target :
       {FormulaTarget::kRig, FormulaTarget::kPlane, FormulaTarget::kAxis, FormulaTarget::kCoil})
    for (const std::string& name : FormulaNames(target))
      EXPECT_TRUE(name[0] == 'i' || Says(page, "`" + name + "`")) << name;
}

class DocsPages : public CliFolder {};

// The example of the page is a rig that runs.
TEST_F(DocsPages, TheFormulaOfThePageRuns) {
  const std::string page = Page("formulas.md");
  const auto begin = page.find("```toml\n") + 8, end = page.find("```", begin);
  const Outcome o =
      Run(ReferenceRigText() + "\n" + page.substr(begin, end - begin), ScenarioText(""));
  EXPECT_EQ(o.exit, 0) << o.text;
}

// Every key that a case's record may have stands in the page about files.
TEST_F(DocsPages, KeysOfCases) {
  Write("rig.toml", ReferenceRigText());
  Write("s.toml", ScenarioText(""));
  ASSERT_EQ(Ambrig("run s.toml --quiet --no-report --out .").exit, 0);
  Write("case.toml",
        "rig = \"rig.toml\"\n[[record]]\nscenario = \"s.toml\"\ndata = \"s.h5\"\nnope = 1\n");
  const Outcome o = Ambrig("compare case.toml");
  ASSERT_EQ(o.exit, 2) << o.text;
  const auto at = o.text.find("allowed: ");
  ASSERT_NE(at, std::string::npos) << o.text;
  std::istringstream keys(o.text.substr(at + 9, o.text.find_first_of("(\n", at) - at - 9));
  const std::string page = Page("files.md");
  int count = 0;
  for (std::string key; std::getline(keys, key, ','); ++count) {
    key.erase(0, key.find_first_not_of(' '));
    key.erase(key.find_last_not_of(" \n") + 1);
    EXPECT_TRUE(Says(page, key)) << key;
  }
  EXPECT_GE(count, 5);
}

// Every port that a scenario may name stands in the page about files, and where results are kept
// between calls.
TEST_F(DocsPages, PortsAndTheCache) {
  const Outcome o =
      Run(ReferenceRigText(), ScenarioText("[[excitation]]\ntarget = \"A.x\"\nport = \"nope\"\n"));
  const auto at = o.text.find("allowed: ");
  ASSERT_NE(at, std::string::npos) << o.text;
  std::istringstream ports(o.text.substr(at + 9, o.text.find_first_of("(\n", at) - at - 9));
  const std::string page = Page("files.md"), about = page.substr(page.find("A **port** is"), 1200);
  int count = 0;
  for (std::string port; std::getline(ports, port, ','); ++count) {
    port.erase(0, port.find_first_not_of(' '));
    port.erase(port.find_last_not_of(" \n") + 1);
    EXPECT_TRUE(Says(about, "`" + port + "`")) << port;
  }
  EXPECT_GE(count, 4);
  for (const char* said : {"## Cache", "`$AMBRIG_CACHE`", "`~/.cache/ambrig`"})
    EXPECT_TRUE(Says(page, said)) << said;
}

}  // namespace
}  // namespace ambrig
