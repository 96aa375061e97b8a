// What is wrong with a whole file, path or command line: one clear line, a non-zero exit, no file
// left behind. (Mistakes inside a file: messages_test.cc.)
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

class BadInputs : public CliFolder {
 protected:
  /// One line, exit 2, names what it should, nothing written.
  void ExpectComplaint(const Outcome& o, const std::string& part) const {
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_NE(o.text.find(part), std::string::npos) << o.text;
    EXPECT_EQ(Files(), "rig.toml s.toml ");
  }
};

TEST_F(BadInputs, GoodInputRuns) {
  const Outcome o = Run(ReferenceRigText(), ScenarioText(""));
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_EQ(Files(), "out/s.h5 out/s.html out/s.json rig.toml s.toml ");
}
TEST_F(BadInputs, TruncatedToml) {
  ExpectComplaint(Run(ReferenceRigText().substr(0, 300), ScenarioText("")), "rig.toml:");
}
TEST_F(BadInputs, NotToml) {
  ExpectComplaint(Run(ReferenceRigText(), "\x01\x02 nonsense"), "s.toml:1: not valid TOML");
}
TEST_F(BadInputs, KeyOfManyNames) {
  std::string key = "a";
  for (int k = 0; k < 100'000; ++k) key += ".a";
  ExpectComplaint(Run("name = \"x\"\n[" + key + "]\nb = 1\n", ScenarioText("")),
                  "rig.toml:2: not valid TOML: a key of more than 32 names");
}
TEST_F(BadInputs, DotsOutsideKeys) {
  const std::string dots =
      "# " + std::string(100, '.') + "\nname = \"" + std::string(100, '.') + "\"\n";
  const Outcome o =
      Run(dots + Replaced(ReferenceRigText(), "name = \"reference\"", ""), ScenarioText(""));
  EXPECT_EQ(o.exit, 0) << o.text;
}
TEST_F(BadInputs, DeepValue) {
  ExpectComplaint(Run("a = " + std::string(100'000, '['), ScenarioText("")),
                  "rig.toml:1: not valid TOML");
}
TEST_F(BadInputs, EmptyRig) { ExpectComplaint(Run("", ScenarioText("")), "rig.toml:"); }
TEST_F(BadInputs, MissingRig) {
  ExpectComplaint(Run(ReferenceRigText(), Replaced(ScenarioText(""), "rig.toml", "no.toml")),
                  "no.toml: no such file");
}
TEST_F(BadInputs, RigIsAFolder) {
  ExpectComplaint(Run(ReferenceRigText(), Replaced(ScenarioText(""), "rig.toml", ".")),
                  "allowed: a file (.: is a folder)");
}
TEST_F(BadInputs, FileWithoutAnEnd) {
  Write("rig.toml", ReferenceRigText());
  Write("s.toml", ScenarioText(""));
  ExpectComplaint(Ambrig("run /dev/zero --quiet"), "/dev/zero: is a device, allowed: a file");
}
TEST_F(BadInputs, UnwritableOut) {
  ExpectComplaint(Run(ReferenceRigText(), ScenarioText(""), "/proc/nowhere"),
                  "cannot write /proc/nowhere");
}
TEST_F(BadInputs, UnknownCommand) {
  const Outcome o = Ambrig("rnu x.toml");
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_EQ(o.lines(), 1) << o.text;
}
TEST_F(BadInputs, UnknownFidelity) {
  Write("rig.toml", ReferenceRigText());
  Write("s.toml", ScenarioText(""));
  ExpectComplaint(Ambrig("run s.toml --quiet --fidelity exact"), "switching");
}
TEST_F(BadInputs, UnknownEffectSuggests) {
  const Outcome o = Ambrig("effects eddy-curents");
  EXPECT_EQ(o.exit, 2);
  EXPECT_NE(o.text.find("did you mean eddy-currents?"), std::string::npos) << o.text;
}

}  // namespace
}  // namespace ambrig
