/// A full disk and Ctrl-C: one line, an exit code that says it, nothing half-written.
#include <sys/mount.h>

#include <csignal>

#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

class StoppedRun : public CliFolder {};

/// A file system of 128 kB, ours to fill; skipped where the kernel does not let us mount one.
class SmallDisk {
 public:
  explicit SmallDisk(const std::filesystem::path& at) : at_(at.string()) {
    std::filesystem::create_directories(at);
    mounted_ = mount("tmpfs", at_.c_str(), "tmpfs", 0, "size=128k") == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount(at_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  std::string at_;
  bool mounted_;
};

TEST_F(StoppedRun, FullDisk) {
  const SmallDisk disk(folder_ / "out");
  if (!disk.mounted()) GTEST_SKIP() << "a tmpfs cannot be mounted here (needs root)";
  const std::string longer = Replaced(ScenarioText(""), "duration = 0.01", "duration = 0.2");
  const Outcome o = Run(ReferenceRigText(), longer);  // 150 channels of 2500 rows
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_NE(o.text.find("cannot write out/s.h5"), std::string::npos) << o.text;
  EXPECT_NE(o.text.find("No space left on device"), std::string::npos) << o.text;
  EXPECT_EQ(Files(), "rig.toml s.toml ");
}

// The record fits, what comes after it does not: complete files or none.
TEST_F(StoppedRun, DiskThatFillsLater) {
  const SmallDisk disk(folder_ / "out");
  if (!disk.mounted()) GTEST_SKIP() << "a tmpfs cannot be mounted here (needs root)";
  const Outcome o =
      Run(ReferenceRigText(), Replaced(ScenarioText(""), "duration = 0.01", "duration = 0.002"));
  EXPECT_EQ(o.exit, 2) << o.text;  // the report with its plotting library is larger than the disk
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_NE(o.text.find("cannot write out/s."), std::string::npos) << o.text;
  EXPECT_EQ(Files().find(".tmp"), std::string::npos) << Files();
  EXPECT_EQ(Files().find("s.html"), std::string::npos) << Files();
}

TEST_F(StoppedRun, FullDevice) {
  Write("rig.toml", ReferenceRigText());
  Write("s.toml", ScenarioText(""));
  const Outcome o = Ambrig("run s.toml --quiet --no-report --json /dev/full");
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_NE(o.text.find("cannot write /dev/full: No space left on device"), std::string::npos)
      << o.text;
}

// What is printed is a result too, of every command.
TEST_F(StoppedRun, FullDiskBehindStandardOutput) {
  Write("rig.toml", ReferenceRigText());
  Write("s.toml", ScenarioText("[expect]\ntouchdown = false\n"));
  Write("a.csv", "t [s],A.x [m]\n0,1\n0.1,2\n0.2,3\n");
  for (const char* call : {"effects", "parameters --markdown", "channels a.csv", "diff a.csv a.csv",
                           "check s.toml", "run s.toml --no-report", "tour --help"}) {
    const Outcome o =
        Shell("(cd " + folder_.string() + " && " + AMBRIG_BINARY + " " + call + " > /dev/full)");
    EXPECT_EQ(o.exit, 2) << call << o.text;
    EXPECT_EQ(o.lines(), 1) << call << o.text;
    EXPECT_NE(o.text.find("cannot write standard output"), std::string::npos) << call << o.text;
  }
}

using Stop = std::pair<const char*, const char*>;  // command, signal
class Interrupted : public StoppedRun, public ::testing::WithParamInterface<Stop> {};

// A minute of simulated time, ended in its first second by the signals of a terminal and of a
// system that stops (a shell without job control starts its jobs deaf to SIGINT: env clears that).
TEST_P(Interrupted, LeavesNothing) {
  const auto& [command, signal] = GetParam();
  Write("rig.toml", ReferenceRigText());
  Write("s.toml", Replaced(ScenarioText(""), "duration = 0.01", "duration = 60.0"));
  Write("more.toml",
        Replaced(ScenarioText("[expect]\ndrop = false\n"), "duration = 0.01", "duration = 60.0"));
  const Outcome o = Shell("cd " + folder_.string() + " && { env --default-signal=INT " +
                          std::string(AMBRIG_BINARY) + " " + command + " & sleep 0.6; kill -" +
                          signal + " $!; wait $!; }");
  EXPECT_EQ(o.exit, 130) << o.text;
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_NE(o.text.find("interrupted"), std::string::npos) << o.text;
  EXPECT_EQ(Files(), "more.toml rig.toml s.toml ");
}
INSTANTIATE_TEST_SUITE_P(
    Command, Interrupted,
    ::testing::Values(Stop{"run s.toml --quiet --out out", "INT"},
                      Stop{"run s.toml --quiet --out out", "TERM"},
                      Stop{"run s.toml --quiet --fidelity reference --out out", "INT"},
                      Stop{"run s.toml --quiet --fidelity averaged --out out", "INT"},
                      Stop{"hide sensor-gain@A.x eddy-currents@A --rig rig.toml -o out", "INT"},
                      Stop{"check more.toml --junit out.xml --json out.json", "INT"}));

}  // namespace
}  // namespace ambrig
