// What a newcomer reads first: every command has help with two examples, and they run as they stand
// in the project's folder; ambrig alone and `ambrig tour` lead somewhere.
#include <set>

#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

std::vector<std::string> Commands() {
  const Outcome o = Shell(std::string(AMBRIG_BINARY) + " --help");
  std::vector<std::string> names;
  std::istringstream lines(o.text);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("ubcommands:") != std::string::npos) inside = true;
    if (!inside || !line.starts_with("  ") || line.size() < 4 || line[2] == ' ') continue;
    if (line.starts_with("  ambrig ")) continue;
    names.push_back(line.substr(2, line.find_first_of(" ,", 2) - 2));
  }
  return names;
}

/// The lines of a help text that begin with "  ambrig ".
std::vector<std::string> ExamplesOf(const std::string& command) {
  const Outcome o = Shell(std::string(AMBRIG_BINARY) + " " + command + " --help");
  EXPECT_EQ(o.exit, 0) << command;
  std::vector<std::string> out;
  std::istringstream lines(o.text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  ambrig " + command)) continue;
    line = line.substr(std::string("  ambrig ").size());
    if (const auto remark = line.find("   "); remark != std::string::npos) line.resize(remark);
    out.push_back(line);
  }
  return out;
}

/// A folder that sees the project's files and may be written to.
class Help : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    for (const char* name : {"scenarios", "examples"})
      std::filesystem::create_directory_symlink(std::filesystem::path(AMBRIG_SOURCE_DIR) / name,
                                                folder_ / name);
  }
};

TEST_F(Help, EveryCommandHasTwoExamples) {
  const std::vector<std::string> commands = Commands();
  EXPECT_GE(commands.size(), 18U);
  for (const std::string& c : commands) EXPECT_GE(ExamplesOf(c).size(), 2U) << c;
}

/// Those that take seconds; the others' are run by the tests of their own rooms.
TEST_F(Help, ExamplesRunAsTheyStand) {
  Shell("cd " + folder_.string() + " && " + AMBRIG_BINARY +
        " run examples/reference/coil_opens.toml --out before --quiet --no-report && mkdir out && "
        "cp before/coil_opens.h5 before/coil_opens.json out/");
  for (const char* command : {"tour", "run", "diff", "effects", "parameters", "rotor",
                              "redistribute", "analyze", "validate"})
    for (const std::string& example : ExamplesOf(command)) {
      const Outcome o = Ambrig(example);
      EXPECT_EQ(o.exit, 0) << "ambrig " << example << "\n" << o.text;
    }
}

TEST_F(Help, AloneItSaysWhereToBegin) {
  const Outcome o = Ambrig("");
  EXPECT_EQ(o.exit, 0);
  EXPECT_NE(o.text.find("ambrig tour"), std::string::npos) << o.text;
}

TEST_F(Help, TourRunsInAnEmptyFolder) {
  EXPECT_EQ(Ambrig("tour -o lessons").exit, 0);
  const Outcome again = Ambrig("tour -o lessons");  // its own files
  EXPECT_EQ(again.exit, 0) << again.text;
  const Outcome first = Shell("cd " + (folder_ / "lessons").string() + " && " + AMBRIG_BINARY +
                              " run coil_opens.toml my_fault.toml --out out");
  EXPECT_EQ(first.exit, 0) << first.text;
  EXPECT_NE(first.text.find("partial-short"), std::string::npos) << first.text;
  Write("lessons/rig.toml", "mine");
  EXPECT_EQ(Ambrig("tour -o lessons").exit, 2);
  EXPECT_EQ(ReadText(folder_ / "lessons/rig.toml"), "mine");
}

}  // namespace
}  // namespace ambrig
