// Bad input ends with one clear line, a non-zero exit and no file left behind.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Outcome {
  int exit = 0;
  std::string text;
};

Outcome Shell(const std::string& command) {
  Outcome out;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  char buffer[512];
  while (std::fgets(buffer, sizeof buffer, pipe)) out.text += buffer;
  out.exit = WEXITSTATUS(pclose(pipe));
  return out;
}

class BadInput : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("ambrig_cli_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    rig_ = Read(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string Read(const std::string& file) {
    std::ifstream in(file);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }
  void Write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  static std::string Replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
  static std::string Scenario(const std::string& more) {
    return "name = \"t\"\nrig = \"rig.toml\"\nduration = 0.01\nrecord_rate = 12500.0\n" + more;
  }
  Outcome Run(const std::string& rig, const std::string& scenario, const std::string& out = "out") const {
    Write("rig.toml", rig);
    Write("s.toml", scenario);
    return Shell("cd " + folder_.string() + " && " + AMBRIG_BINARY + " run s.toml --quiet --out " + out);
  }
  /// One line, exit 2, names what it should, nothing written.
  void ExpectComplaint(const Outcome& o, const std::string& part) const {
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(std::count(o.text.begin(), o.text.end(), '\n'), 1) << o.text;
    EXPECT_NE(o.text.find(part), std::string::npos) << o.text;
    EXPECT_FALSE(fs::exists(folder_ / "out" / "s.h5"));
  }

  fs::path folder_;
  std::string rig_;
};

TEST_F(BadInput, GoodInputRuns) {
  const Outcome o = Run(rig_, Scenario(""));
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_TRUE(fs::exists(folder_ / "out" / "s.h5"));
  EXPECT_TRUE(fs::exists(folder_ / "out" / "s.html"));
}
TEST_F(BadInput, TruncatedToml) { ExpectComplaint(Run(rig_.substr(0, 300), Scenario("")), "rig.toml:"); }
TEST_F(BadInput, NotToml) { ExpectComplaint(Run(rig_, "\x01\x02 nonsense"), "s.toml:1: not valid TOML"); }
TEST_F(BadInput, MissingRig) { ExpectComplaint(Run(rig_, Replaced(Scenario(""), "rig.toml", "no.toml")), "no.toml"); }
TEST_F(BadInput, NegativeGap) {
  ExpectComplaint(Run(Replaced(rig_, "value = 4.0e-4", "value = -4.0e-4"), Scenario("")), "bearings.A.gap = -0.0004 m, allowed");
}
TEST_F(BadInput, NotANumber) { ExpectComplaint(Run(Replaced(rig_, "kp = 4.0 ", "kp = nan "), Scenario("")), "amplifier.kp"); }
TEST_F(BadInput, Infinite) { ExpectComplaint(Run(Replaced(rig_, "kd = 900.0 ", "kd = inf "), Scenario("")), "controller.kd"); }
TEST_F(BadInput, ClearanceAboveGap) {
  ExpectComplaint(Run(Replaced(rig_, "clearance = 2.0e-4", "clearance = 5.0e-4"), Scenario("")), "clearance = 0.0005 m, allowed");
}
TEST_F(BadInput, MisspeltKeySuggests) {
  ExpectComplaint(Run(Replaced(rig_, "turns = 50", "truns = 50"), Scenario("")), "turns");
}
TEST_F(BadInput, FaultOnCoilNine) {
  ExpectComplaint(Run(rig_, Scenario("[[fault]]\ntime = 0.005\ntarget = \"A.coil9\"\nkind = \"open\"\n")), "A.coil9");
}
TEST_F(BadInput, SpeedGoesBackInTime) {
  ExpectComplaint(Run(rig_, Scenario("[speed]\nprofile = [[0.0, 1.0], [0.2, 2.0], [0.1, 3.0]]\n")), "goes back in time");
}
TEST_F(BadInput, UnwritableOut) { ExpectComplaint(Run(rig_, Scenario(""), "/proc/nowhere"), "cannot write"); }
TEST_F(BadInput, UnknownCommand) {
  const Outcome o = Shell(std::string(AMBRIG_BINARY) + " rnu x.toml");
  EXPECT_EQ(o.exit, 2) << o.text;
}
TEST_F(BadInput, UnknownEffectSuggests) {
  const Outcome o = Shell(std::string(AMBRIG_BINARY) + " effects eddy-curents");
  EXPECT_EQ(o.exit, 2);
  EXPECT_NE(o.text.find("did you mean eddy-currents?"), std::string::npos) << o.text;
}
TEST_F(BadInput, HelpOfEveryCommand) {
  for (const char* command : {"run", "check", "redistribute", "effects", "compare", "explain", "adopt"}) {
    const Outcome o = Shell(std::string(AMBRIG_BINARY) + " " + command + " --help");
    EXPECT_EQ(o.exit, 0) << command;
    EXPECT_NE(o.text.find("Example"), std::string::npos) << command;
  }
}

}  // namespace
