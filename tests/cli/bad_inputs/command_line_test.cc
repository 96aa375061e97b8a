// Bad options, paths and files of every command: exit code, one line, what it names, nothing left
// behind and nothing overwritten.
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

struct BadCommand {
  const char *arguments, *said;
  int exit = 2;
};
void PrintTo(const BadCommand& c, std::ostream* out) { *out << c.arguments; }

const BadCommand kCommands[] = {
    {"runn s.toml", "runn is no command, did you mean run?"},
    {"simulate s.toml", "simulate is no command, did you mean run?"},
    {"workbench", "workbench is no command, did you mean serve?"},
    {"gui", "gui is no command, did you mean serve?"},
    {"help", "help is no command, did you mean --help?"},
    {"qqqqqqqq s.toml", "qqqqqqqq is no command; allowed: "},
    {"run", "allowed: scenario files"},
    {"run none.toml", "none.toml: no such file"},
    {"run .", "a folder, allowed: scenario files"},
    {"run locked.h5", "not valid TOML"},
    {"run s.toml s.toml", "another scenario of that file name"},
    {"run s.toml --rate nan", "allowed: 0.001 to 1e+09 Hz"},
    {"run s.toml --rate 0", "allowed: 0.001 to 1e+09 Hz"},
    {"run s.toml --rate -1", "allowed: 0.001 to 1e+09 Hz"},
    {"run s.toml --rate fast", "allowed: 0.001 to 1e+09 Hz"},
    {"run s.toml --rate 1e9", "--rate = 1000000000 Hz, allowed: the switching frequency"},
    {"run s.toml --rate 1", "--rate = 1 Hz, allowed: at least 100 Hz, one row in the duration"},
    {"run s.toml --rate 13000", "--rate = 13000 Hz, allowed: the switching frequency"},
    {"run s.toml --fidelity exact", "switching"},
    {"run s.toml --json /no/such/x.json", "cannot write /no/such/x.json"},
    {"hide sensor-gain --rig rig.toml -o h --seed 1e3", "--seed = 1e3, allowed: an integer"},
    {"run s.toml --json ''", "--json: a file without a name"},
    {"run s.toml --html .", "cannot write .: Is a directory"},
    {"run s.toml --out s.toml", "cannot write s.toml"},
    {"run s.toml --json rig.toml", "rig.toml is read by this command"},
    {"run s.toml --json kept.json", "kept.json exists and is not an output of ambrig"},
    {"run s.toml --html kept.html", "kept.html exists and is not an output of ambrig"},
    {"run s.toml --out kept", "kept/s.h5 exists and is not an output of ambrig"},
    {"run huge.toml", "the record would need"},
    {"run long.toml", "would take about"},
    {"run s.toml --row 3", "--from-campaign"},
    {"run nul.toml", "control character 0"},
    {"check", "path is required"},
    {"check empty", "no scenario with [expect] found"},
    {"check none", "none: no such file or folder"},
    {"check e.toml --junit /no/such.xml", "cannot write /no/such.xml"},
    {"check e.toml --jobs 0", "--jobs"},
    {"check e.toml --accept", "--accept: allowed together with --baseline DIR"},
    {"check e.toml --baseline none", "no such baseline", 1},
    {"check e.toml --baseline b --accept --channels Q.q", "no channel of the record fits", 1},
    {"diff a.csv", "B is required (see ambrig diff --help)"},
    {"diff a.csv b.csv c.csv d.csv",
     "ambrig: c.csv: one argument more than ambrig diff takes (see"},
    {"diff a.csv --against b.csv c.csv",
     "ambrig: --against is no option of ambrig diff (see ambrig"},
    {"diff a.csv --relativ=1", "--relativ=1 is no option of ambrig diff, did you mean --relative?"},
    {"--quiet run s.toml", "--quiet is no option of ambrig (see ambrig --help)"},
    {"diff rig.toml s.toml", "s.toml:1: rotor: is missing, allowed: a table [rotor]"},
    {"diff none.h5 none.h5", "none.h5: no such file"},
    {"diff locked.h5 locked.h5", "locked.h5"},
    {"diff a.csv b.csv --relative nan", "allowed: 0 to 10"},
    {"diff a.csv b.csv --absolute -1", "allowed: 0 to 1e+12"},
    {"diff a.csv b.csv --tolerances none.toml", "none.toml: no such file"},
    {"diff a.csv b.csv --tolerances t.toml", "t.toml:2: all.relativ: unknown key"},
    {"diff a.csv b.csv --json a.csv", "a.csv is read by this command"},
    {"diff untimed.csv a.csv", "neither a rate [Hz] nor a time channel, allowed: t, time (s)"},
    {"channels backwards.csv", "column t: row 4: time 0.1 s does not increase"},
    {"diff backwards.csv a.csv", "column t: row 4: time 0.1 s does not increase"},
    {"analyze rig.toml --speed fast", "--speed = fast, allowed: rpm"},
    {"analyze rig.toml --speed 9:3", "the lower speed first"},
    {"analyze rig.toml --speed nan", "--speed = nan, allowed: rpm"},
    {"analyze rig.toml --max-speed nan", "allowed: 1 to 1e+07 rpm"},
    {"analyze rig.toml --sine inf", "allowed: 1e-09 to 1e+06 N"},
    {"analyze none.toml", "none.toml: no such file"},
    {"analyze rig.toml -o rig.toml", "cannot write rig.toml"},
    {"analyze rig.toml --json rig.toml", "rig.toml is read by this command"},
    {"crosscheck e.toml --step nan", "allowed: 0.05 to 10 us"},
    {"crosscheck e.toml --step 0", "allowed: 0.05 to 10 us"},
    {"campaign c.toml --poll nan", "allowed: 0.1 to 3600 s"},
    {"campaign c.toml --shard 3/2", "--shard = 3/2, allowed: i/n"},
    {"campaign none.toml", "none.toml: no such file"},
    {"campaign lost.toml", "lost.toml:1: rig = \"no.toml\", allowed: a file (no.toml"},
    {"design lost_study.toml", "lost_study.toml:3: candidate[1].rig = \"no.toml\""},
    {"detectors lost_detectors.toml", "lost_detectors.toml:1: healthy = \"no.toml\""},
    {"rotor convert bad.json shaft.toml", "bad.json:2:3: not valid JSON"},
    {"rotor convert cut.json shaft.toml", "not valid JSON: it ends too early"},
    {"rotor convert bad.json rig.toml", "rig.toml exists and is not an output of ambrig"},
    {"rotor convert rig.toml rig.toml", "rig.toml is read by this command"},
    {"hide sensor-gain --rig rig.toml --seed -1 -o h", "allowed: 0 to"},
    {"hide sensor-gain --rig rig.toml --seed nan -o h", "allowed: 0 to"},
    {"hide sensor-gain@A.x sensor-gain@B.y --rig rig.toml -o h", "sensor-gain is named twice"},
    {"hide sensor-gain --rig rig.toml -o kept", "kept/case.toml exists and is not an output"},
    {"explain case_twice.toml", "is fitted and validated"},
    {"explain case.toml --json /no/such/x.json", "cannot write /no/such/x.json"},
    {"explain case_noise.toml", "noise.A.x = 1e+308 m, allowed 0 to 0.1 m"},
    {"compare case_column.toml", "column \"A_q1\" of A.i1 is not in a.csv, allowed: A."},
    {"compare lost_case.toml",
     "lost_case.toml:3: record[1].scenario = \"no.toml\", allowed: a file"},
    {"compare none.toml", "none.toml: no such file"},
    {"adopt case.toml nothing", "nothing"},
    {"effects eddy-curents", "did you mean eddy-currents?"},
    {"parameters --json /no/such/x.json", "cannot write /no/such/x.json"},
    {"validate empty", "no NAME.validation.toml found"},
};

class BadCommands : public CliFolder, public ::testing::WithParamInterface<BadCommand> {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    Write("rig.toml", ReferenceRigText());
    Write("s.toml", ScenarioText(""));
    Write("e.toml", ScenarioText("[expect]\ntouchdown = false\n"));
    const std::string s = ScenarioText("");
    Write("huge.toml", Replaced(s, "duration = 0.01", "duration = 1e5"));
    Write("long.toml", Replaced(Replaced(s, "duration = 0.01", "duration = 1e5"),
                                "record_rate = 12500.0", "record_rate = 1.0"));
    Write("nul.toml", Replaced(s, "\"rig.toml\"", "\"rig.toml\\u0000x\""));
    Write("locked.h5", "no HDF5 at all");
    std::string rows = "t,A.x,A.i1\n";
    for (int k = 0; k < 10; ++k) rows += "0.00" + std::to_string(k) + ",1,2\n";
    Write("a.csv", rows);
    Write("b.csv", rows);
    Write("untimed.csv", "x,z\n0,1\n1,2\n");
    Write("backwards.csv", "t,z\n0,1\n0.1,2\n0.1,3\n");
    Write("t.toml", "[all]\nrelativ = 1.0\n");
    Write("c.toml", "name = \"c\"\nrig = \"rig.toml\"\nduration = 0.01\n");
    Write("lost.toml", "rig = \"no.toml\"\nduration = 0.01\n");
    Write("lost_study.toml", "[[candidate]]\nname = \"a\"\nrig = \"no.toml\"\n");
    Write("lost_detectors.toml", "healthy = \"no.toml\"\nfaulty = \"no.toml\"\n");
    Write("bad.json", "{\n  oops: 1 }");
    Write("cut.json", "{ \"a\": ");
    const std::string record = "[[record]]\nscenario = \"s.toml\"\ndata = \"a.csv\"\n";
    Write("case.toml", "rig = \"rig.toml\"\n" + record);
    Write("case_twice.toml", record + record + "use = \"validate\"\n");
    Write("case_noise.toml", "noise = { \"A.x\" = 1e308 }\n" + record);
    Write("case_column.toml", record + "[record.channels]\n\"A.i1\" = \"A_q1\"\n");
    Write("lost_case.toml",
          "rig = \"rig.toml\"\n[[record]]\nscenario = \"no.toml\"\ndata = \"a.csv\"\n");
    Write("kept.json", "{ \"mine\": 1 }");
    Write("kept.html", "<html>mine</html>");
    std::filesystem::create_directories(folder_ / "kept");
    std::filesystem::create_directories(folder_ / "empty");
    Write("kept/s.h5", "a measurement");
    Write("kept/record-1.h5", "a measurement");
    Write("kept/case.toml", "a case");
  }
};

TEST_P(BadCommands, OneLineNothingWritten) {
  const std::string before = Files();
  const Outcome o = Ambrig(GetParam().arguments);
  EXPECT_EQ(o.exit, GetParam().exit) << o.text;
  if (GetParam().exit == 2) {
    EXPECT_EQ(o.lines(), 1) << o.text;
  }
  EXPECT_NE(o.text.find(GetParam().said), std::string::npos) << o.text;
  EXPECT_EQ(Files(), before) << o.text;
  EXPECT_EQ(ReadText(folder_ / "rig.toml"), ReferenceRigText());
  EXPECT_EQ(ReadText(folder_ / "kept/s.h5"), "a measurement");
}
INSTANTIATE_TEST_SUITE_P(Table, BadCommands, ::testing::ValuesIn(kCommands));

class CommandLine : public CliFolder {};

// A reader that has seen enough is no error; a cache that cannot be read costs time only.
TEST_F(CommandLine, ClosedPipe) {
  const Outcome o =
      Shell(std::string("{ (") + AMBRIG_BINARY + " parameters; echo exit $? >&2) | head -1; }");
  EXPECT_NE(o.text.find("exit 0"), std::string::npos) << o.text;
  EXPECT_EQ(o.text.find("error"), std::string::npos) << o.text;
}

TEST_F(CommandLine, UnreadableCache) {
  Write("rig.toml", ReferenceRigText());
  Write("cache", "a file where the folder should be");
  const Outcome o = Shell("cd " + folder_.string() + " && AMBRIG_CACHE=cache/x " + AMBRIG_BINARY +
                          " redistribute rig.toml --bearing A --failed 1");
  EXPECT_EQ(o.exit, 0) << o.text;
}

TEST_F(CommandLine, SetsWithoutACoil) {
  Write("rig.toml", ReferenceRigText());
  for (const char* failed : {"';;'", "';'", "'1;;2'"}) {
    const Outcome o = Ambrig(std::string("redistribute rig.toml --bearing A --failed ") + failed);
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_NE(o.text.find("a set without a coil, allowed: 1 to 8"), std::string::npos) << o.text;
  }
  const Outcome o = Ambrig("redistribute rig.toml --bearing A --failed ''");  // not all 255 sets
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_NE(o.text.find("a set without a coil"), std::string::npos) << o.text;
}

// Root reads every folder, so that it takes another user's rights for this.
TEST_F(CommandLine, UnreadableFolders) {
  const std::string user =
      geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
  if (Shell(user + AMBRIG_BINARY + " --version").exit != 0)
    GTEST_SKIP() << "the program cannot be run as another user than root here";
  std::filesystem::create_directory(folder_ / "shut");
  Write("shut/s.toml", ScenarioText(""));
  std::filesystem::permissions(folder_ / "shut", geteuid() == 0 ? std::filesystem::perms::owner_all
                                                                : std::filesystem::perms::none);
  const Outcome o = Shell("cd " + folder_.string() + " && " + user + AMBRIG_BINARY + " check shut");
  std::filesystem::permissions(folder_ / "shut", std::filesystem::perms::owner_all);
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_EQ(o.text, "ambrig: shut: Permission denied\n");
}

// Tables of a campaign or a study that another program wrote stay.
TEST_F(CommandLine, ForeignTablesStay) {
  Write("table.csv", "mine\n");
  const std::string library = AMBRIG_SOURCE_DIR;
  for (const std::string& work :
       {"campaign " + library + "/scenarios/campaigns/one_blow.toml -o .",
        "design " + library + "/examples/design/small.toml -o .",
        "detectors " + library + "/scenarios/studies/detectors_small.toml -o ."}) {
    const Outcome o = Ambrig(work);
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_NE(o.text.find("table.csv exists and is not an output of ambrig"), std::string::npos)
        << o.text;
    EXPECT_EQ(ReadText(folder_ / "table.csv"), "mine\n");
  }
}

TEST_F(CommandLine, RunsOverWhatItMadeAndForcesTheRest) {
  Write("rig.toml", ReferenceRigText());
  Write("s.toml", ScenarioText(""));
  for (int k = 0; k < 2; ++k) {
    const Outcome o = Ambrig("run s.toml --quiet --csv --json all.json --html all.html");
    EXPECT_EQ(o.exit, 0) << o.text;
  }
  Write("all.json", "[]");
  EXPECT_EQ(Ambrig("run s.toml --quiet --json all.json").exit, 2);
  EXPECT_EQ(Ambrig("run s.toml --quiet --json all.json --force").exit, 0);
}

}  // namespace
}  // namespace ambrig
