// Results that ambrig score keeps are those of their own case, whatever its folder is called.
#include <nlohmann/json.hpp>

#include "tests/cli/work_folder.h"

namespace ambrig {
namespace {

class KeptScores : public WorkFolder {
 protected:
  /// A case of one short record in FOLDER/case-01.
  void MakeCase(const std::string& folder, const std::string& duration) {
    Write("s.toml", Replaced(ScenarioText(""), "duration = 0.01", "duration = " + duration));
    const Outcome run = Ambrig("run s.toml --no-report --force --out " + folder + "/case-01");
    ASSERT_TRUE(run.exit == 0 || run.exit == 1) << run.text;
    for (const char* file : {"rig.toml", "s.toml"})
      std::filesystem::copy_file(folder_ / file, folder_ / folder / "case-01" / file,
                                 std::filesystem::copy_options::overwrite_existing);
    Write(folder + "/case-01/case.toml",
          "rig = \"rig.toml\"\n[[record]]\nscenario = \"s.toml\"\ndata = \"s.h5\"\n");
    Write(folder + "/answers.toml", "[\"case-01\"]\nverdict = [\"none\"]\neffects = []\n");
  }
  /// Folders of the cases that a result names among its inputs.
  std::set<std::string> CasesOf(const std::string& file) const {
    std::set<std::string> folders;
    const auto result = nlohmann::json::parse(ReadText(folder_ / file), nullptr, false);
    for (const auto& [input, hash] : result["provenance"]["inputs"].items())
      if (input.ends_with("case.toml")) folders.insert(input.substr(0, input.find('/')));
    return folders;
  }
};

TEST_F(KeptScores, AreNotThoseOfAnotherFolderOfTheSameName) {
  MakeCase("one", "0.02");
  MakeCase("two", "0.03");
  const Outcome both = Ambrig("score one two -o both --json all.json");
  ASSERT_EQ(both.exit, 0) << both.text;
  EXPECT_EQ(CasesOf("both/one-case-01.json"), std::set<std::string>{"one"});
  EXPECT_EQ(CasesOf("both/two-case-01.json"), std::set<std::string>{"two"});
  EXPECT_EQ(CasesOf("all.json"), (std::set<std::string>{"one", "two"}));
  for (const char* folder : {"one", "two"}) {  // one after the other into the same folder
    const Outcome o = Ambrig(std::string("score ") + folder + " -o same");
    ASSERT_EQ(o.exit, 0) << o.text;
    EXPECT_EQ(CasesOf("same/case-01.json"), std::set<std::string>{folder});
  }
  const std::string kept = ReadText(folder_ / "same/case-01.json");
  ASSERT_EQ(Ambrig("score two -o same").exit, 0);
  EXPECT_EQ(ReadText(folder_ / "same/case-01.json"), kept);  // with the seconds that it took
  MakeCase("two", "0.025");                                  // other data in the same files
  ASSERT_EQ(Ambrig("score two -o same").exit, 0);
  EXPECT_NE(ReadText(folder_ / "same/case-01.json"), kept);
}

TEST_F(KeptScores, CasesOfOneNameAndFolderNameAreRefused) {
  MakeCase("a/set", "0.02");
  std::filesystem::create_directories(folder_ / "b");
  std::filesystem::copy(folder_ / "a/set", folder_ / "b/set",
                        std::filesystem::copy_options::recursive);
  const Outcome o = Ambrig("score a/set b/set -o out");
  EXPECT_EQ(o.exit, 2);
  EXPECT_NE(o.text.find("a second case with the name set-case-01"), std::string::npos) << o.text;
}

}  // namespace
}  // namespace ambrig
