// Whole runs with a controller in C: as a user writes the rig file, in runs and campaigns, behind
// sockets, with a coil that breaks.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/record/hdf5.h"
#include "tests/campaign/campaign_folder.h"
#include "tests/control/external/external_site.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig::testing {
namespace {

const std::string kExternalGains =
    "parameters = { kp = 4.0e5, kd = 900.0, ki = 6.0e6, derivative_time_constant = 1.5e-4 }\n";

/// The reference rig with these lines of [controller].
std::string RigText(const std::string& controller) {
  const std::string text = ReferenceText();
  return text.substr(0, text.find("[controller]")) +
         "[controller]\nrate = 12500.0\nbias_current = 2.0\nf_max = 60.0\n" + controller + "\n" +
         text.substr(text.find("[bearings.A]"));
}

std::string LibraryLines(const std::string& module, const std::string& more) {
  return "kind = \"library\"\nfile = \"" + Module(module) + "\"\n" + more;
}

const std::string kScenario =
    "name = \"s\"\nrig = \"RIG\"\nduration = 0.03\nfault_tolerance = false\nnoise = "
    "true\n[speed]\nprofile = [[0.0, "
    "300.0]]\n[[load]]\nplane = \"A\"\nforce = [20.0, 0.0]\nstart = 0.005\nstop = 0.02\n";

std::string ScenarioOf(const std::string& rig, const std::string& more = "") {
  std::string text = kScenario + more;
  return text.replace(text.find("RIG"), 3, rig);
}

TEST(ExternalRun, ThePidInCGivesTheBitsOfThePid) {
  const CampaignFolder f;
  f.Write("pid.toml", RigText("kind = \"pid\"\n" + kPidGains));
  f.Write("c.toml", RigText(LibraryLines("pid", kExternalGains)));
  f.Write("ours.toml", ScenarioOf("pid.toml"));
  f.Write("theirs.toml", ScenarioOf("c.toml"));
  const Outcome run = f.Ambrig("run ours.toml theirs.toml --no-report");
  ASSERT_EQ(run.exit, 0) << run.text;
  const Record a = ReadHdf5(f.File("out/ours.h5")), b = ReadHdf5(f.File("out/theirs.h5"));
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t k = 0; k < a.channels.size(); ++k) {
    EXPECT_GT(a.channels[k].samples.size(), 100u);
    EXPECT_EQ(a.channels[k].samples, b.channels[k].samples) << a.channels[k].name;
  }
}

// Firmware at a Unix and a TCP socket: the same bits again.
TEST(ExternalRun, FirmwareBehindASocket) {
  const CampaignFolder f;
  f.Write("c.toml", RigText(LibraryLines("pid", kExternalGains)));
  f.Write("unix.toml",
          RigText("kind = \"socket\"\naddress = \"unix:pid.sock\"\n" + kExternalGains));
  f.Write("tcp.toml",
          RigText("kind = \"socket\"\naddress = \"tcp:127.0.0.1:47913\"\n" + kExternalGains));
  for (const char* rig : {"c", "unix", "tcp"})
    f.Write(std::string("run_") + rig + ".toml", ScenarioOf(std::string(rig) + ".toml"));
  const Outcome gone = f.Ambrig("run run_unix.toml --no-report");
  EXPECT_EQ(gone.exit, 2);
  EXPECT_NE(gone.text.find("controller.address = \"unix:pid.sock\": cannot be reached: No such "
                           "file or directory"),
            std::string::npos)
      << gone.text;
  const std::string host = std::string(AMBRIG_CONTROLLER_HOST) + " " + Module("pid");
  const Outcome run =
      f.In(host + " --listen unix:pid.sock & one=$!; " + host +
           " --listen tcp:47913 & two=$!; trap 'kill $one $two' EXIT; for k in $(seq 100); do [ -S "
           "pid.sock ] && break; sleep 0.05; done; sleep 0.3; " AMBRIG_BINARY
           " run run_c.toml run_unix.toml run_tcp.toml --no-report --quiet");
  ASSERT_EQ(run.exit, 0) << run.text;
  const Record c = ReadHdf5(f.File("out/run_c.h5"));
  for (const char* other : {"out/run_unix.h5", "out/run_tcp.h5"}) {
    const Record r = ReadHdf5(f.File(other));
    for (std::size_t k = 0; k < c.channels.size(); ++k)
      EXPECT_EQ(c.channels[k].samples, r.channels[k].samples) << c.channels[k].name;
  }
}

// The guide's lines: the controller's source linked with the host instead of loaded by it.
TEST(ExternalRun, FirmwareLinkedWithTheHost) {
  const CampaignFolder f;
  f.Write("c.toml", RigText(LibraryLines("pid", kExternalGains)));
  f.Write("fw.toml",
          RigText("kind = \"socket\"\naddress = \"unix:firmware.sock\"\n" + kExternalGains));
  f.Write("a.toml", ScenarioOf("c.toml"));
  f.Write("b.toml", ScenarioOf("fw.toml"));
  const std::string external = AMBRIG_SOURCE_DIR "/control/external";
  const Outcome cc = f.In(AMBRIG_C_COMPILER
                          " -std=c99 -D_GNU_SOURCE -DAMBRIG_LINKED -Wall -Wextra -Wpedantic "
                          "-Werror -ffp-contract=off -I " +
                          external + " " + external +
                          "/host/*.c " AMBRIG_SOURCE_DIR
                          "/examples/controllers/pid.c -ldl -pthread -lm -o firmware");
  ASSERT_EQ(cc.exit, 0) << cc.text;
  const Outcome run = f.In(
      "./firmware --listen unix:firmware.sock & one=$!; trap 'kill $one' EXIT; for k in $(seq "
      "100); do [ -S firmware.sock ] && break; sleep 0.05; done; " AMBRIG_BINARY
      " run a.toml b.toml --no-report --quiet");
  ASSERT_EQ(run.exit, 0) << run.text;
  const Record a = ReadHdf5(f.File("out/a.h5")), b = ReadHdf5(f.File("out/b.h5"));
  for (std::size_t k = 0; k < a.channels.size(); ++k)
    EXPECT_EQ(a.channels[k].samples, b.channels[k].samples) << a.channels[k].name;
}

// One row is ended by its controller; the campaign goes on and says why.
TEST(ExternalRun, ACampaignGoesOn) {
  const CampaignFolder f;
  for (const char* how : {"1", "2", "4", "5"}) {
    f.Write("rig.toml", RigText(LibraryLines("misbehaves", std::string("parameters = { how = ") +
                                                               how + ", from_speed = 100 }\n")));
    f.Write("c.toml",
            "name = \"c\"\nrig = \"rig.toml\"\nduration = 0.004\nseeds = 2\n[operation]\nspeeds = "
            "[0.0, 157.0]\n");
    const Outcome run = f.Ambrig(std::string("campaign c.toml --no-report -o out") + how);
    ASSERT_EQ(run.exit, 0) << run.text;
    const std::string table = f.Read(std::string("out") + how + "/table.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5) << table;
    std::size_t ended = 0;
    for (std::size_t at = table.find("step at t = "); at != std::string::npos;
         at = table.find("step at t = ", at + 1))
      ++ended;
    EXPECT_EQ(ended, 2u) << table;
  }
}

TEST(ExternalRun, ARunEndsWithOneLineAndTheNextOneGoesOn) {
  const CampaignFolder f;
  f.Write("bad.toml", RigText(LibraryLines("misbehaves", "parameters = { how = 4 }\n")));
  f.Write("good.toml", RigText(LibraryLines("pid", kExternalGains)));
  f.Write("first.toml", ScenarioOf("bad.toml"));
  f.Write("second.toml", ScenarioOf("good.toml"));
  const Outcome run = f.Ambrig("run first.toml second.toml --keep-going --no-report --quiet");
  EXPECT_EQ(run.exit, 2);
  EXPECT_NE(run.text.find("crashed: it touched memory that is not its own (SIGSEGV)"),
            std::string::npos)
      << run.text;
  EXPECT_EQ(std::count(run.text.begin(), run.text.end(), '\n'), 1) << run.text;
  EXPECT_GT(ReadHdf5(f.File("out/second.h5")).channels.size(), 10u);
}

// Coil A3 breaks under a load of 20 N and nobody but the controller in C looks: with it the rotor
// does not touch its auxiliary bearing, with the PID it falls onto it.
TEST(ExternalRun, TheFaultTolerantOneCarriesOnWithSevenCoils) {
  const CampaignFolder f;
  f.Write("pid.toml", RigText(LibraryLines("pid", kExternalGains)));
  f.Write("tolerant.toml",
          RigText(LibraryLines("fault_tolerant", "commands = \"currents\"\n" + kExternalGains)));
  for (const char* rig : {"pid", "tolerant"}) {
    const std::string name = std::string("s_") + rig;
    f.Write(name + ".toml",
            "name = \"s\"\nrig = \"" + std::string(rig) +
                ".toml\"\nduration = 0.09\nfault_tolerance = false\n[speed]\nprofile = [[0.0, "
                "300.0]]\n[[load]]\nplane = \"A\"\nforce = [20.0, 0.0]\nstart = 0.005\nstop = "
                "0.2\n[[fault]]\nkind = \"open\"\ntarget = \"A.coil3\"\ntime = 0.05\n");
    const Outcome run = f.Ambrig("run " + name + ".toml --no-report");
    ASSERT_EQ(run.exit, 0) << run.text;
    const bool touched =
        f.Read("out/" + name + ".json").find("\"touchdown\": true") != std::string::npos;
    EXPECT_EQ(touched, std::string(rig) == "pid") << run.text;
    EXPECT_NEAR(ReadHdf5(f.File("out/" + name + ".h5")).Find("A.i3")->samples.back(), 0, 0.05);
  }
}

TEST(ExternalRun, MistakesInTheRigFile) {
  const auto text = [](const std::string& lines) {
    return ErrorText<InputError>([&] { RigWith(lines); });
  };
  EXPECT_NE(text("kind = \"library\"\n").find("controller.file"), std::string::npos);
  EXPECT_NE(text("kind = \"library\"\nfile = \"none.so\"\n").find("controller.file = \"none.so\""),
            std::string::npos);
  EXPECT_NE(text(LibraryLines("pid", "timeout = 0.0\n")).find("timeout = 0 s, allowed 0.01 to"),
            std::string::npos);
  EXPECT_NE(text(LibraryLines("pid", "commands = \"flux\"\n")).find("allowed: forces, currents"),
            std::string::npos);
  for (const char* address :
       {"", "tcp:", "tcp::80", "tcp:host:0", "tcp:host:x", "unix:", "udp:a:1"})
    EXPECT_NE(text(std::string("kind = \"socket\"\naddress = \"") + address + "\"\n")
                  .find("allowed: \"unix:PATH\" or \"tcp:HOST:PORT\""),
              std::string::npos)
        << address;
}

TEST(ExternalRun, AnalyzeSaysThatThereIsNoLinearModel) {
  const CampaignFolder f;
  f.Write("rig.toml", RigText(LibraryLines("pid", kExternalGains)));
  const Outcome run = f.Ambrig("analyze rig.toml");
  EXPECT_EQ(run.exit, 2) << run.text;
  EXPECT_NE(run.text.find("has no linear model"), std::string::npos) << run.text;
}

}  // namespace
}  // namespace ambrig::testing
