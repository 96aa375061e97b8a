// Names of files are bytes: what an old system wrote in Latin-1 is no UTF-8, and JSON is.
#include <nlohmann/json.hpp>

#include "tests/cli/work_folder.h"

namespace ambrig {
namespace {

class FileNames : public WorkFolder {
 protected:
  void SetUp() override {
    WorkFolder::SetUp();
    Write("r\xfe.toml", ReferenceRigText());
    Write("s\xff.toml", ScenarioText(""));
    Write("a\xff.csv", ReadText(folder_ / "a.csv"));
    Write("c\xff.toml", "rig = \"rig.toml\"\nduration = 0.01\n");
  }
};

TEST_F(FileNames, ThatAreNoUtf8AreTaken) {
  for (const char* command :
       {"run s\xff.toml --quiet --no-report --out o", "check s\xff.toml", "rig r\xfe.toml",
        "redistribute r\xfe.toml --failed 1", "analyze r\xfe.toml --speed 1000",
        "channels a\xff.csv", "diff a\xff.csv a\xff.csv",
        "campaign c\xff.toml -o camp --no-report"}) {
    const Outcome o = Ambrig(std::string(command) + " --json j.json --force");
    EXPECT_LT(o.exit, 2) << command << o.text;
    EXPECT_TRUE(nlohmann::json::accept(ReadText(folder_ / "j.json"))) << command;
    std::filesystem::remove(folder_ / "j.json");
  }
}

// setup.json of an FMU names the file: it would not be found again.
TEST_F(FileNames, OfAnFmuAreUtf8) {
  ExpectRefused(Ambrig("export r\xfe.toml --fmu x.fmu"), "a name that is no UTF-8 text, allowed");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.fmu"));
}

}  // namespace
}  // namespace ambrig
