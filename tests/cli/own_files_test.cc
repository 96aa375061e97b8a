// Text files that a command wrote carry the mark of ambrig and a hash of their lines: the command
// replaces them when it is run again, and refuses when somebody changed them since.
#include "app/commands/outputs.h"
#include "tests/cli/work_folder.h"

namespace ambrig {
namespace {

struct Writer {
  const char* name;
  const char* call;
  std::vector<std::string> files;
  const char* before = "";  // another call of ambrig that makes the inputs
};

const Writer kWriters[] = {
    {"hide",
     "hide sensor-gain --rig rig.toml -o h",
     {"h/case.toml", "h/rig.toml", "h/record-1.toml", "h.answer.toml"}},
    {"new", "new --answers examples/new/spindle.toml --only-files -o n", {"n/rig.toml"}},
    {"tour", "tour -o t", {"t/rig.toml", "t/my_fault.toml"}},
    {"practice",
     "practice rig.toml --cases 1 --make-only -o p",
     {"p/case-0001/case.toml", "p/case-0001/rig.toml", "p/case-0001/record-1.toml",
      "p/case-0001.answer.toml", "p/answers.toml"}},
    {"commission", "commission rig.toml --duration 0.1 -o learnt.toml", {"learnt.toml"}},
    {"rotor",
     "rotor convert r.json back.toml",
     {"back.toml"},
     "rotor convert examples/shaft/shaft.toml r.json"},
    {"adopt",
     "adopt seen.toml saturation@A -o x.toml --case y.toml",
     {"x.toml", "y.toml"},
     "run seen_s.toml --no-report --out seen"},
    {"refine",
     "refine seen.toml saturation@A -o x.toml --case y.toml",
     {"x.toml", "y.toml"},
     "run seen_s.toml --no-report --out seen"},
    {"plan", "plan rig.toml --learn side-pull@A cross-coupling@A --draws 0 -o p.toml", {"p.toml"}},
};

class OwnFiles : public WorkFolder, public ::testing::WithParamInterface<Writer> {
 protected:
  void SetUp() override {
    WorkFolder::SetUp();
    Write("seen_s.toml", Replaced(ScenarioText(""), "duration = 0.01", "duration = 0.02"));
    Write(
        "seen.toml",
        "rig = \"rig.toml\"\n[[record]]\nscenario = \"seen_s.toml\"\ndata = \"seen/seen_s.h5\"\n");
    if (!*GetParam().before) return;
    const Outcome o = Ambrig(GetParam().before);
    ASSERT_TRUE(o.exit == 0 || o.exit == 1) << o.text;
  }
};

TEST_P(OwnFiles, AreReplacedUntilSomebodyChangesThem) {
  const Outcome first = Ambrig(GetParam().call);
  ASSERT_TRUE(first.exit == 0 || first.exit == 1) << first.text;
  std::istringstream lines(first.text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  for (const std::string& file : GetParam().files) {
    const std::string written = ReadText(folder_ / file);
    EXPECT_TRUE(written.starts_with("# made by ambrig ")) << file;
    EXPECT_NE(written.rfind("\n# hash of the lines above: "), std::string::npos) << file;
    EXPECT_NO_THROW(RefuseOverwriting({(folder_ / file).string()}, false));
    Write(file, written + "# a note of my own\n");
    ExpectRefused(Ambrig(GetParam().call), file + " was changed since ambrig wrote it");
    EXPECT_EQ(ReadText(folder_ / file), written + "# a note of my own\n");
    // Who edits a file may delete its last line too.
    const std::size_t last = written.rfind("# hash of the lines above: ");
    Write(file, written.substr(0, last) + "# mine\n");
    ExpectRefused(Ambrig(GetParam().call), file + " was changed since ambrig wrote it");
    Write(file, written);
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, OwnFiles, ::testing::ValuesIn(kWriters),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace ambrig
