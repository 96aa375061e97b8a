// Commands that print what the program knows: effects, parameters, and what they say is in the
// sources' tables and nowhere else.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "effects/catalogue.h"
#include "rig/parameters/rig_parameters.h"
#include "scenarios/faults/fault.h"
#include "tests/app/html_page.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class CatalogueCommands : public CliFolder {
 protected:
  Json JsonOf(const std::string& command) const {
    const Outcome o = Ambrig(command + " --json out.json");
    EXPECT_EQ(o.exit, 0) << o.text;
    return Json::parse(ReadText(folder_ / "out.json"));
  }
};

TEST_F(CatalogueCommands, EffectsAreThoseOfTheCatalogue) {
  const Json all = JsonOf("effects");
  ASSERT_EQ(all.size(), Catalogue().size());
  const Outcome list = Ambrig("effects");
  EXPECT_GE(static_cast<std::size_t>(list.lines()), Catalogue().size());
  // long titles go on in the next line
  const std::string words = std::regex_replace(list.text, std::regex("\\s+"), " ");
  std::size_t k = 0;
  for (const EffectDescription& d : Catalogue()) {
    EXPECT_EQ(all[k]["name"], d.id);
    EXPECT_EQ(all[k]["parameters"].size(), d.parameters.size()) << d.id;
    EXPECT_FALSE(all[k]["target"].get<std::string>().empty()) << d.id;
    EXPECT_FALSE(all[k]["physics"].get<std::string>().empty()) << d.id;
    EXPECT_THAT(words, HasSubstr(d.title)) << d.id;
    ++k;
  }
}

// Bounds that are infinite are words in JSON, and read back.
TEST_F(CatalogueCommands, OneEffectInDetail) {
  const Outcome o = Ambrig("effects eddy-currents");
  EXPECT_EQ(o.exit, 0);
  EXPECT_THAT(o.text, HasSubstr("cutoff"));
  EXPECT_THAT(o.text, HasSubstr("[Hz]"));
  EXPECT_THAT(o.text, Not(HasSubstr("hysteresis -")));
  const Json j = JsonOf("effects eddy-currents");
  ASSERT_EQ(j.size(), 1u);
  for (const Json& p : j[0]["parameters"])
    if (p["name"] == "cutoff") {
      EXPECT_EQ(p["null"], "inf");
      EXPECT_EQ(p["unit"], "Hz");
    }
}

TEST_F(CatalogueCommands, ParametersAreTheTablesOfTheReaders) {
  const Json all = JsonOf("parameters");
  std::set<std::pair<std::string, std::string>> listed;
  for (const Json& line : all) listed.emplace(line["section"], line["key"]);
  for (const ParameterRow& row : RigParameterRows())
    EXPECT_TRUE(listed.contains({row.section, row.key})) << row.section << " " << row.key;
  for (const Fault* f : Faults()) {
    const std::string section = "[[fault]] kind = \"" + std::string(f->kind) + "\"";
    EXPECT_TRUE(listed.contains({section, ""})) << section;
    for (const FaultParameter& p : f->parameters)
      EXPECT_TRUE(listed.contains({section, "parameters." + std::string(p.key)})) << section;
  }
  for (const Json& line : all)
    if (line["section"] == "[rotor]" && line["key"] == "mass") {
      EXPECT_EQ(line["default"], "required");
      EXPECT_EQ(line["unit"], "kg");
    }
}

/// Last parts of the keys at the starts of lines; names of channels stand in quotes.
std::set<std::string> KeysIn(const std::string& text) {
  std::set<std::string> keys;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end =
        line.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789.");
    if (end == 0 || end == std::string::npos ||
        line.find_first_not_of(' ', end) == std::string::npos ||
        line[line.find_first_not_of(' ', end)] != '=')
      continue;
    const std::string key = line.substr(0, end);
    keys.insert(key.substr(key.rfind('.') + 1));
  }
  return keys;
}

// What rig, scenario and case files of the examples and the library write is on the page.
TEST_F(CatalogueCommands, EveryKeyOfTheExamplesIsListed) {
  std::set<std::string> listed;
  for (const Json& line : JsonOf("parameters")) {
    std::string key = line["key"];
    for (char& c : key)
      if (c == ',' || c == '.') c = ' ';
    std::istringstream words(key);
    for (std::string word; words >> word;) listed.insert(word);
  }
  int files = 0;
  for (const char* folder : {"/examples", "/scenarios/library"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(AMBRIG_SOURCE_DIR + std::string(folder))) {
      if (entry.path().extension() != ".toml") continue;
      const std::string text = ReadText(entry.path());
      const bool rig = text.find("\n[rotor]") != std::string::npos &&
                       text.find("\n[amplifier]") != std::string::npos;
      if (!rig && text.find("\nrig = ") == std::string::npos) continue;
      ++files;
      for (const std::string& key : KeysIn(text)) EXPECT_TRUE(listed.contains(key)) << entry << key;
    }
  EXPECT_GT(files, 60);
}

TEST_F(CatalogueCommands, PagesHoldTheSameRows) {
  ASSERT_EQ(Ambrig("parameters --html p.html").exit, 0);
  ASSERT_EQ(Ambrig("effects --html e.html").exit, 0);
  const std::string parameters = testing::Words(ReadText(folder_ / "p.html")),
                    effects = testing::Words(ReadText(folder_ / "e.html"));
  EXPECT_THAT(parameters, HasSubstr("\n[rotor]\nmass\nkg\nrequired\n"));
  EXPECT_THAT(parameters, HasSubstr("the coil detector, as open"));
  EXPECT_THAT(ReadText(folder_ / "p.html"), HasSubstr("type=\"search\""));
  for (const EffectDescription& d : Catalogue())
    EXPECT_THAT(effects, HasSubstr("\n" + d.id + "\n")) << d.id;
}

}  // namespace
}  // namespace ambrig
