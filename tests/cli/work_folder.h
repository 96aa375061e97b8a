#pragma once
/// A folder with an input for every command: a rig (and the same under another name), scenarios, a
/// campaign, a case of two records, an empty folder of a logger, and the scenarios and examples of
/// the source tree.
#include <gmock/gmock.h>

#include <string>

#include "tests/cli/cli_run.h"

namespace ambrig {

class WorkFolder : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    for (const char* name : {"scenarios", "examples"})
      std::filesystem::create_directory_symlink(std::filesystem::path(AMBRIG_SOURCE_DIR) / name,
                                                folder_ / name);
    Write("rig.toml", ReferenceRigText());
    Write("other.toml", ReferenceRigText());
    Write("s.toml", ScenarioText(""));
    Write("e.toml", ScenarioText("[expect]\ndrop = false\n"));
    Write("c.toml", "rig = \"rig.toml\"\nduration = 0.01\n");
    std::string rows = "t,A.x\n";
    for (int k = 0; k < 100; ++k)
      rows += std::to_string(k / 12500.0) + (k % 2 ? ",1e-6\n" : ",2e-6\n");
    Write("a.csv", rows);
    Write("b.csv", rows);
    Write("case.toml",
          "rig = \"rig.toml\"\n[[record]]\nscenario = \"s.toml\"\ndata = \"a.csv\"\n"
          "[[record]]\nscenario = \"s.toml\"\ndata = \"b.csv\"\n");
    std::filesystem::create_directories(folder_ / "logger");
  }
  static void ExpectRefused(const Outcome& o, const std::string& said) {
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_THAT(o.text, ::testing::HasSubstr(said));
  }
};

}  // namespace ambrig
