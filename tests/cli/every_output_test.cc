// Every option of every command that names a file or folder to write: a path that cannot be written
// is refused before the work, and what ambrig did not make stays as it is. The table is held
// against the help texts: a new option has its row, or is listed as one that names what is read.
#include <gmock/gmock.h>

#include <sys/stat.h>

#include <set>

#include "tests/cli/work_folder.h"

namespace ambrig {
namespace {

struct Output {
  const char *command, *option;
  const char* call;         // {}: where the output goes
  const char* inside = "";  // of a folder: a file that would be written there; "" for a file
  const char* before = "";  // another call of ambrig that makes the inputs
};

const Output kOutputs[] = {
    {"tour", "--out", "tour -o {}", "rig.toml"},
    {"new", "--out", "new --answers examples/new/spindle.toml -o {}", "rig.toml"},
    {"run", "--out", "run s.toml --no-report --out {}", "s.h5"},
    {"check", "--junit", "check e.toml --junit {}"},
    {"check", "--baseline", "check e.toml --accept --baseline {}", "e.baseline.h5"},
    {"campaign", "--out", "campaign c.toml -o {}", "table.csv"},
    {"merge", "--out", "merge part -o {}", "table.csv", "campaign c.toml -o part"},
    {"detectors", "--out", "detectors scenarios/studies/detectors_small.toml -o {}", "table.csv"},
    {"commission", "--out", "commission rig.toml -o {}"},
    {"design", "--out", "design examples/design/small.toml -o {}", "table.csv"},
    {"export", "--controller-c", "export rig.toml --controller-c {}"},
    {"export", "--fmu", "export rig.toml --fmu {}"},
    {"watch", "--journal", "watch case.toml logger --journal {}"},
    {"analyze", "--out", "analyze other.toml -o {}", "other.analysis.json"},
    {"analyze", "--out", "analyze examples/shaft/shaft.toml -o {}", "shaft.analysis.html"},
    {"rotor", "OUT", "rotor convert examples/shaft/shaft.toml {}"},
    {"compare", "--series", "compare case.toml --series {}"},
    {"explain", "--law", "explain case.toml --law {}"},
    {"adopt", "--out", "adopt case.toml sensor-gain --target A.x -o {}"},
    {"refine", "--out", "refine case.toml saturation@A -o {}"},
    {"plan", "--out", "plan case.toml -o {}"},
    {"hide", "--out", "hide sensor-gain --rig rig.toml -o {}", "case.toml"},
    {"score", "--out", "score made -o {}", "made.json", "hide sensor-gain --rig rig.toml -o made"},
    {"practice", "--out", "practice rig.toml --cases 1 --make-only -o {}", "case-0001/case.toml"},
    {"practice", "--fit", "practice rig.toml --cases 1 --fit {}"},
    {"serve", "--address-file", "serve . --address-file {}"},
};

class EveryOutput : public WorkFolder, public ::testing::WithParamInterface<Output> {
 protected:
  void SetUp() override {
    WorkFolder::SetUp();
    if (*GetParam().before) {
      const Outcome o = Ambrig(GetParam().before);
      ASSERT_EQ(o.exit, 0) << o.text;
    }
  }
  Outcome CalledFor(const std::string& place) const {
    return Ambrig(Replaced(GetParam().call, "{}", place));
  }
};

// Nothing can be made in /proc, by nobody. The work of each of these calls takes longer.
TEST_P(EveryOutput, IsTriedBeforeTheWork) {
  ExpectRefused(CalledFor("/proc/nowhere"), "cannot write /proc/nowhere");
}

TEST_P(EveryOutput, LeavesWhatIsNotAmbrigs) {
  const std::string inside = GetParam().inside, file = inside.empty() ? "mine" : "mine/" + inside;
  std::filesystem::create_directories((folder_ / file).parent_path());
  Write(file, "mine");
  ExpectRefused(CalledFor("mine"), file + " exists and is not an output of ambrig");
  EXPECT_EQ(ReadText(folder_ / file), "mine");
}

// Opened, a pipe without a reader would wait for one for ever, after all the work.
TEST_P(EveryOutput, IsNoNamedPipe) {
  const std::string inside = GetParam().inside, file = inside.empty() ? "mine" : "mine/" + inside;
  std::filesystem::create_directories((folder_ / file).parent_path());
  ASSERT_EQ(mkfifo((folder_ / file).c_str(), 0600), 0);
  for (const char* forced : {"", " --force"}) {
    const Outcome o = Shell("cd " + folder_.string() + " && timeout -s KILL 60 " + AMBRIG_BINARY +
                            " " + Replaced(GetParam().call, "{}", "mine") + forced);
    ExpectRefused(o, "cannot write ");
    EXPECT_THAT(o.text, ::testing::HasSubstr(file + ": "));
  }
}

/// Row by row a name for a test.
std::string OutputTestName(const ::testing::TestParamInfo<Output>& of) {
  std::string name =
      of.param.command + std::string("_") + of.param.option + std::to_string(of.index);
  std::erase_if(name, [](char c) { return c == '-'; });
  return name;
}

INSTANTIATE_TEST_SUITE_P(Options, EveryOutput, ::testing::ValuesIn(kOutputs), OutputTestName);

/// Without commands that take long, do not end or ask for an ending of the name.
std::vector<Output> QuickOutputs() {
  const std::set<std::string> left_out = {"explain", "plan",      "refine", "adopt", "score",
                                          "watch",   "detectors", "design", "serve", "rotor"};
  std::vector<Output> out;
  for (const Output& o : kOutputs)
    if (!left_out.contains(o.command) && std::string(o.option) != "--fit") out.push_back(o);
  return out;
}

class QuickOutput : public EveryOutput {};

// Once more into the same place: own files carry a mark and are replaced.
TEST_P(QuickOutput, OfTheSameCommandIsReplaced) {
  for (int time = 1; time <= 2; ++time) {
    const Outcome o = CalledFor("made_twice");
    ASSERT_EQ(o.exit, 0) << "time " << time << ": " << o.text;
  }
}

INSTANTIATE_TEST_SUITE_P(Options, QuickOutput, ::testing::ValuesIn(QuickOutputs()), OutputTestName);

/// Options that name what is read, and folders that hold nothing of anybody else's.
const std::set<std::string> kInputs = {"--from-campaign", "--tolerances", "--answers", "--record",
                                       "--rig",           "--campaign",   "--learn",   "--resume",
                                       "--engine",        "--shard",      "--scenario"};
/// Of every command: tests/cli/other_outputs_test.cc.
const std::set<std::string> kCommon = {"--json", "--html", "--help"};

/// Long names of a command's options with the text that follows, up to the next option.
std::vector<std::pair<std::string, std::string>> OptionsOf(const std::string& command) {
  std::vector<std::pair<std::string, std::string>> out;
  std::istringstream help(Shell(std::string(AMBRIG_BINARY) + " " + command + " --help").text);
  for (std::string line; std::getline(help, line);) {
    const auto at = line.find("--");
    // the older of two names is not tried
    if (const auto alias = line.find(",--", at); at < 8 && alias != std::string::npos)
      line.erase(alias, line.find(' ', alias) - alias);
    if (line.starts_with("  -") && at < 8)
      out.emplace_back(line.substr(at, line.find_first_of(" :=", at) - at), line);
    else if (!line.starts_with("     "))
      out.emplace_back("", "");
    else if (!out.empty())
      out.back().second += " " + line;
  }
  return out;
}

TEST(EveryOutputTable, HasEveryOptionThatNamesAFile) {
  std::istringstream help(Shell(std::string(AMBRIG_BINARY) + " --help").text);
  bool inside = false;
  std::size_t seen = 0;
  for (std::string line; std::getline(help, line);) {
    if (line.find("ubcommands:") != std::string::npos) inside = true;
    if (!inside || !line.starts_with("  ") || line.starts_with("  ambrig ") || line[2] == ' ')
      continue;
    const std::string command = line.substr(2, line.find_first_of(" ,", 2) - 2);
    for (const auto& [option, text] : OptionsOf(command)) {
      const bool file =
          text.find(" FILE") != std::string::npos || text.find(" FOLDER") != std::string::npos ||
          text.find("folder") != std::string::npos || text.find(" file") != std::string::npos;
      const bool flag = text.find(option + " TEXT") == std::string::npos &&
                        text.find(option + " FILE") == std::string::npos &&
                        text.find(option + " FOLDER") == std::string::npos &&
                        text.find(option + " REQUIRED") == std::string::npos;
      if (option.empty() || !file || flag || kInputs.contains(option) || kCommon.contains(option))
        continue;
      ++seen;
      const bool listed =
          std::any_of(std::begin(kOutputs), std::end(kOutputs),
                      [&](const Output& o) { return command == o.command && option == o.option; });
      EXPECT_TRUE(listed) << command << " " << option << ": " << text;
    }
  }
  EXPECT_GE(seen, 20U);
}

}  // namespace
}  // namespace ambrig
