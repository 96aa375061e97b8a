// What ambrig did not make is never overwritten, by any command: the file stays, exit code 2, one
// line, before any work; and never what a command reads.
#include <gmock/gmock.h>

#include <chrono>

#include "tests/cli/work_folder.h"

namespace ambrig {
namespace {

/// How each command is called so that it would write; its inputs are made below.
struct Call {
  const char *command, *arguments;
  const char* input = "";  // a file that it reads
};

const Call kCalls[] = {
    {"new", "--answers examples/new/spindle.toml --only-files -o spindle"},
    {"run", "s.toml --out out --no-report", "s.toml"},
    {"check", "e.toml"},
    {"diff", "a.csv b.csv", "a.csv"},
    {"campaign", "c.toml -o camp", "c.toml"},
    {"commission", "rig.toml -o learnt.toml", "rig.toml"},
    {"crosscheck", "e.toml"},
    {"design", "examples/design/small.toml -o study"},
    {"redistribute", "rig.toml --failed 1", "rig.toml"},
    {"export", "rig.toml --controller-c own.c", "rig.toml"},
    {"analyze", "rig.toml", "rig.toml"},
    {"rig", "rig.toml", "rig.toml"},
    {"validate", "examples/validation"},
    {"paper", "examples/paper"},
    {"effects", ""},
    {"parameters", ""},
    {"channels", "a.csv", "a.csv"},
    {"compare", "case.toml", "case.toml"},
    {"explain", "case.toml", "case.toml"},
    {"watch", "case.toml logger --no-explain", "case.toml"},
    {"adopt", "case.toml sensor-gain --target A.x -o adopted.toml", "case.toml"},
    {"refine", "case.toml saturation@A -o refined.toml", "case.toml"},
    {"plan", "case.toml -o next.toml", "case.toml"},
    {"practice", "rig.toml --cases 1 -o cases", "rig.toml"},
};

class OtherOutputs : public WorkFolder, public ::testing::WithParamInterface<Call> {
 protected:
  void SetUp() override {
    WorkFolder::SetUp();
    Write("mine.json", "{ \"mine\": true }");
    Write("mine.html", "<html>mine</html>");
  }
  std::string Called(const std::string& option) const {
    return std::string(GetParam().command) + " " + GetParam().arguments + " " + option;
  }
};

TEST_P(OtherOutputs, StayAsTheyAre) {
  for (const char* kind : {"json", "html"}) {
    const std::string file = std::string("mine.") + kind, before = ReadText(folder_ / file);
    if (Ambrig(std::string(GetParam().command) + " --help").text.find(std::string("--") + kind) ==
        std::string::npos)
      continue;
    const auto begin = std::chrono::steady_clock::now();
    ExpectRefused(Ambrig(Called(std::string("--") + kind + " " + file)),
                  file + " exists and is not an output of ambrig");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
    EXPECT_EQ(ReadText(folder_ / file), before);
  }
}

TEST_P(OtherOutputs, InputsAreNotOverwritten) {
  const std::string input = GetParam().input;
  if (input.empty()) GTEST_SKIP() << "reads no file of the user's own";
  const std::string before = ReadText(folder_ / input);
  const Outcome o = Ambrig(Called("--force --json " + input));
  ExpectRefused(o, input + " is read by this command");
  EXPECT_EQ(ReadText(folder_ / input), before);
}

INSTANTIATE_TEST_SUITE_P(Commands, OtherOutputs, ::testing::ValuesIn(kCalls),
                         [](const auto& of) { return std::string(of.param.command); });

// A new command that writes JSON has its row above.
TEST(OtherOutputsTable, HasEveryCommandWithOutputs) {
  std::istringstream help(Shell(std::string(AMBRIG_BINARY) + " --help").text);
  bool inside = false;
  for (std::string line; std::getline(help, line);) {
    if (line.find("ubcommands:") != std::string::npos) inside = true;
    if (!inside || !line.starts_with("  ") || line.starts_with("  ambrig ") || line[2] == ' ')
      continue;
    const std::string command = line.substr(2, line.find_first_of(" ,", 2) - 2);
    if (Shell(std::string(AMBRIG_BINARY) + " " + command + " --help").text.find("--json") ==
        std::string::npos)
      continue;
    const bool listed = std::any_of(std::begin(kCalls), std::end(kCalls),
                                    [&](const Call& c) { return command == c.command; });
    const bool elsewhere = command == "merge" || command == "score" || command == "hide" ||
                           command == "detectors" || command == "rotor" || command == "tour";
    EXPECT_TRUE(listed || elsewhere) << command;
  }
}

}  // namespace
}  // namespace ambrig
