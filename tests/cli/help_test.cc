// What a newcomer reads first: every command has help with two examples, and they run as they stand
// in the project's folder; ambrig alone and `ambrig tour` lead somewhere.
#include <set>

#include "app/text/screen.h"
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
    if (!line.starts_with("  ambrig ")) continue;
    line = line.substr(std::string("  ambrig ").size());
    if (const auto remark = line.find("   "); remark != std::string::npos) line.resize(remark);
    out.push_back(line);
  }
  return out;
}

/// No line is wider than 80 columns, but for one that holds a path or a file's text.
void ExpectNarrow(const std::string& text, const std::string& call) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_of("/{") == std::string::npos) {
      EXPECT_LE(ScreenWidth(line), kScreenColumns) << "ambrig " << call << ":\n" << line;
    }
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

// Every line of every help text fits a terminal of 80 columns.
TEST_F(Help, LinesFitTheTerminal) {
  std::vector<std::string> calls = {"", "--help", "rotor convert --help"};
  for (const std::string& c : Commands()) calls.push_back(c + " --help");
  for (const std::string& call : calls) ExpectNarrow(Ambrig(call).text, call);
}

// Nor is a line broken twice: a footer's line that is wider than the screen leaves a few words on
// the next one.
TEST_F(Help, FootersAreNotBrokenTwice) {
  for (const std::string& c : Commands()) {
    std::istringstream lines(Ambrig(c + " --help").text);
    std::string last;
    for (std::string line; std::getline(lines, line); last = line) {
      if (line.empty() || last.empty() || line[0] == ' ' || last[0] == ' ') continue;
      if (line.starts_with("Usage:") || last.ends_with('.') || last.ends_with(':')) continue;
      EXPECT_GE(ScreenWidth(last) + 1 + ScreenWidth(line.substr(0, line.find(' '))), 60U)
          << c << ":\n"
          << last << "\n"
          << line;
    }
  }
}

// A command's help ends with its own examples, not with those of the whole program.
TEST_F(Help, FootersAreTheCommandsOwn) {
  for (const std::string& c : Commands())
    EXPECT_EQ(Ambrig(c + " --help").text.find("ambrig tour/"), std::string::npos) << c;
  EXPECT_NE(Ambrig("rotor --help").text.find("ambrig rotor convert"), std::string::npos);
}

struct Examples {
  const char* command;
  std::vector<const char*> before = {};  // what the help says to do first
  bool slow = false;                     // minutes: only with AMBRIG_SLOW_TESTS=1 (nightly)
  bool endless = false;                  // runs until Ctrl-C: tests/workbench
};

const Examples kExamples[] = {
    {"tour"},
    {"new"},
    {"run"},
    {"check"},
    {"diff"},
    {"campaign"},
    {"merge",
     {"campaign scenarios/campaigns/one_blow.toml --shard 1/2 -o part1",
      "campaign scenarios/campaigns/one_blow.toml --shard 2/2 -o part2"}},
    {"detectors", {}, true},
    {"commission"},
    {"crosscheck"},
    {"rig"},
    {"rotor"},
    {"design"},
    {"redistribute"},
    {"export"},
    {"analyze"},
    {"validate"},
    {"paper"},
    {"effects"},
    {"parameters"},
    {"compare"},
    {"explain", {}, true},
    {"adopt", {"hide sensor-gain --rig examples/reference/rig.toml -o practice"}, true},
    {"hide"},
    {"channels"},
    {"refine", {"hide saturation@A --rig examples/reference/rig.toml -o practice"}, true},
    {"plan", {"hide sensor-gain --rig examples/reference/rig.toml -o practice"}, true},
    {"practice", {}, true},
    {"watch",
     {"hide sensor-gain --rig examples/reference/rig.toml -o practice",
      "hide sensor-gain --rig examples/reference/rig.toml -o logger"},
     true},
    {"serve", {}, false, true},
    {"score", {"hide sensor-gain --rig examples/reference/rig.toml -o practice"}, true},
};

class HelpExamples : public Help, public ::testing::WithParamInterface<Examples> {};

TEST_P(HelpExamples, RunAsTheyStand) {
  const Examples& e = GetParam();
  if (e.endless) GTEST_SKIP() << "runs until Ctrl-C: tests/workbench starts it";
  if (e.slow && std::getenv("AMBRIG_SLOW_TESTS") == nullptr)
    GTEST_SKIP() << "takes minutes: AMBRIG_SLOW_TESTS=1 runs it";
  for (const char* first : e.before) {
    const Outcome o = Ambrig(first);
    ASSERT_EQ(o.exit, 0) << first << "\n" << o.text;
  }
  for (const std::string& example : ExamplesOf(e.command)) {
    const Outcome o = Ambrig(example);
    EXPECT_EQ(o.exit, 0) << "ambrig " << example << "\n" << o.text;
    ExpectNarrow(o.text, example);
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, HelpExamples, ::testing::ValuesIn(kExamples),
                         [](const auto& of) { return std::string(of.param.command); });

TEST_F(Help, EveryCommandsExamplesAreRun) {
  std::set<std::string> run;
  for (const Examples& e : kExamples) run.insert(e.command);
  const std::vector<std::string> all = Commands();
  EXPECT_EQ(run, std::set<std::string>(all.begin(), all.end()));
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
