// Bad uses of the commands round a case, a bench and an export, and of records of other kinds: exit
// code 2, one line that names option or file and what is allowed, nothing written.
#include "tests/cli/work_folder.h"

namespace ambrig {
namespace {

struct BadUse {
  const char *arguments, *said;
};
void PrintTo(const BadUse& u, std::ostream* out) { *out << u.arguments; }

const BadUse kUses[] = {
    // two outputs that would be one file
    {"run s.toml --json x.json --html ./x.json", "x.json is named for two outputs"},
    {"run s.toml --out . --json s.h5", "s.h5 is named for two outputs"},
    {"run s.toml --out . --json s.json", "s.json is named for two outputs"},
    {"commission rig.toml -o x.toml --json x.toml", "x.toml is named for two outputs"},
    {"export rig.toml --fmu x.c --controller-c x.c", "x.c is named for two outputs"},
    {"export rig.toml --controller-c ambrig_controller.h", "is named for two outputs"},
    {"refine case.toml saturation@A -o x.toml --case x.toml", "x.toml is named for two outputs"},
    {"adopt case.toml sensor-gain -o x.toml --case ./x.toml", "x.toml is named for two outputs"},
    {"plan case.toml -o x.toml --json x.toml", "x.toml is named for two outputs"},
    {"explain case.toml --law x.json --json x.json", "x.json is named for two outputs"},
    {"watch case.toml logger --journal x --json x", "x is named for two outputs"},
    {"analyze rig.toml --json x --html x", "x is named for two outputs"},
    {"compare case.toml --series x --json x", "x is named for two outputs"},
    {"run s.toml e.toml --html x.html", "--html: one report for several scenarios, allowed: one"},
    // effects and their targets
    {"refine case.toml saturation@", "effect = \"saturation@\", allowed: EFFECT or EFFECT@TARGET"},
    {"refine case.toml @A", "effect = \"@A\", allowed: EFFECT or EFFECT@TARGET"},
    {"hide sensor-gain@ --rig rig.toml -o h", "effect = \"sensor-gain@\", allowed: EFFECT or"},
    {"hide '' --rig rig.toml -o h", "effect = \"\", allowed: EFFECT or EFFECT@TARGET"},
    {"adopt case.toml sensor-gain@", "effect = \"sensor-gain@\", allowed: EFFECT or"},
    {"adopt case.toml sensor-gain@A.x --target B.x", "--target = B.x: sensor-gain@A.x names one"},
    {"adopt case.toml sensor-gain@Q", "--target = Q, allowed with sensor-gain: A.x"},
    {"plan case.toml --between nothing", "--between: one name, allowed: two or more"},
    {"plan case.toml --between nothing nothing", "--between: nothing is named twice"},
    {"plan case.toml --between saturation@ nothing", "effect = \"saturation@\", allowed"},
    {"plan rig.toml --learn side-pull@A side-pull@A", "--learn: side-pull@A is named twice"},
    // practice
    {"practice rig.toml ./rig.toml --cases 1 --make-only", "./rig.toml is named twice, allowed"},
    {"practice rig.toml --make-only --report-only", "--report-only"},
    {"practice rig.toml --report-only -o none", "none: no such folder, allowed with --report-only"},
    // a bench of one's own
    {"new --answers examples/new/ball.toml --column A=B -o x", "channel \"A\", allowed: M.x"},
    {"new --answers examples/new/ball.toml -o ''", "--out = \"\", allowed: a folder"},
    {"new --template one-axis --set mass=1 mass=2 -o x", "--set: mass is named twice, allowed"},
    // what a command cannot take
    {"redistribute ball.toml --failed 1", "ball.toml: has no bearing whose coils could take over"},
    {"run --from-campaign c.toml", "--row is missing or negative, allowed with --from-campaign"},
    {"channels logger", "logger: is a folder, allowed: a file"},
    {"rotor convert short.json x.toml", "short.json: shaft section \"Shaft Element 0\": length"},
    {"run untimed.toml", "untimed.toml:1: duration: is missing, allowed 1e-06 to 100000 s"},
    {"validate off_node.validation.toml", "off_node.validation.toml:"},
    // static tables
    {"compare static_gap.toml", "row 2: A at [0.04, 0] m, allowed: inside the gap of 0.0004 m"},
    {"compare late_clock.toml", "late_clock.toml:3: nuisance.time_shift = 1000000000 s, allowed 0"},
    {"compare static_sd.toml", "static_sd.toml:6: record[1].sd.A.fx = 0 N, allowed 1e-15 to"},
};

class BadUses : public WorkFolder, public ::testing::WithParamInterface<BadUse> {
 protected:
  void SetUp() override {
    WorkFolder::SetUp();
    Write("ball.toml", ReadText(AMBRIG_SOURCE_DIR "/examples/mls2em/rig.toml"));
    const std::string ross =
        ReadText(AMBRIG_SOURCE_DIR "/tests/rotor/ross_files/v2.3.0_rotor_example.json");
    Write("short.json", Replaced(ross, "0.25", "-0.25"));
    Write("untimed.toml", "rig = \"rig.toml\"\n");
    Write("off_node.validation.toml",
          Replaced(
              ReadText(AMBRIG_SOURCE_DIR "/examples/validation/friswell_unbalance.validation.toml"),
              "unbalance = { z = 0.5,", "unbalance = { z = 0.511,"));
    Write("table.csv", "x,F\n0,1\n4e-5,2\n");
    const std::string table =
        "rig = \"rig.toml\"\n[[record]]\nkind = \"static\"\ndata = \"table.csv\"\n";
    Write("static_gap.toml", table +
                                 "[record.channels]\n\"A.x\" = { column = \"x\", gain = 1000.0 }\n"
                                 "\"A.fx\" = \"F\"\n");
    Write("late_clock.toml",
          "rig = \"rig.toml\"\n[nuisance]\ntime_shift = 1e9\n[[record]]\nscenario = "
          "\"s.toml\"\ndata = \"a.csv\"\n");
    Write("static_sd.toml", table +
                                "[record.sd]\n\"A.fx\" = 0.0\n[record.channels]\n\"A.x\" = \"x\"\n"
                                "\"A.fx\" = \"F\"\n");
  }
};

TEST_P(BadUses, OneLineNothingWritten) {
  const std::string before = Files();
  ExpectRefused(Ambrig(GetParam().arguments), GetParam().said);
  EXPECT_EQ(Files(), before);
}
INSTANTIATE_TEST_SUITE_P(Table, BadUses, ::testing::ValuesIn(kUses));

class Outputs : public WorkFolder {};

// A device may take two outputs, and --html is written where the folder's own report is not wanted.
TEST_F(Outputs, OneReportWithoutTheFoldersOwn) {
  const Outcome o = Ambrig("run s.toml --quiet --no-report --html x.html --json /dev/null");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "x.html"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/s.html"));
  EXPECT_EQ(Ambrig("effects --json /dev/null --html /dev/null").exit, 0);
}

// What is open already is written in place; a reader that went away is an error, not a wait.
TEST_F(Outputs, PipesOfTheShellAreWritten) {
  const auto bash = [&](const std::string& line) {
    Write("line.sh", line + "\n");
    return Shell("cd " + folder_.string() + " && AMBRIG=" + AMBRIG_BINARY +
                 " timeout -s KILL 60 bash line.sh");
  };
  const std::string begin = "[\n  {\n    \"made_by\": \"ambrig\"", call = "$AMBRIG effects --json ";
  for (const char* line : {"/dev/stdout > file; cat file", "/dev/stdout | cat",
                           ">(cat > file) > text; sleep 1; cat file",
                           "/dev/fd/3 3> file > text; cat file", "/dev/stdout > pipe & cat pipe"}) {
    Shell("cd " + folder_.string() + " && rm -f file pipe && mkfifo pipe");
    EXPECT_THAT(bash(call + line).text, ::testing::HasSubstr(begin)) << line;
  }
  const Outcome o = bash("exec 3> >(true); sleep 1; " + call + "/dev/fd/3 > text");
  ExpectRefused(o, "cannot write /dev/fd/3: Broken pipe");
}

// What is written as text says who made it.
TEST_F(Outputs, FilesOfAHiddenCaseAreMarked) {
  ASSERT_EQ(Ambrig("hide sensor-gain --rig rig.toml --exact -o h").exit, 0);
  for (const char* file : {"h.answer.toml", "h/case.toml", "h/rig.toml", "h/record-1.toml"})
    EXPECT_TRUE(ReadText(folder_ / file).starts_with("# made by ambrig hide\n")) << file;
}

// Readings that never move are left out; where nothing else was measured there is no answer, least
// of all agreement.
TEST_F(Outputs, NothingMeasuredIsNoAgreement) {
  std::string rows = "t,A.x\n";
  for (int k = 0; k < 100; ++k) rows += std::to_string(k / 12500.0) + ",1e-6\n";
  Write("a.csv", rows);
  Write("b.csv", rows);
  const std::string said = "case.toml: every channel of every record was left out";
  for (const char* call : {"compare case.toml --no-blocks", "explain case.toml --candidates 1"}) {
    const Outcome o = Ambrig(call);  // what was left out is printed before
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_THAT(o.text, ::testing::HasSubstr(said));
    EXPECT_THAT(o.text, ::testing::Not(::testing::HasSubstr("error over noise")));
  }
  ExpectRefused(Ambrig("adopt case.toml sensor-gain -o x.toml"), said);
}

// A table of which no reading is a number is not in agreement either.
TEST_F(Outputs, ATableWithoutANumberIsRefused) {
  Write("table.csv", "x,F\n0,nan\n1e-5,nan\n2e-5,nan\n3e-5,nan\n");
  Write("t.toml",
        "rig = \"rig.toml\"\n[[record]]\nkind = \"static\"\ndata = \"table.csv\"\n"
        "[record.channels]\n\"A.x\" = \"x\"\n\"A.fx\" = \"F\"\n");
  const Outcome o = Ambrig("compare t.toml");
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_THAT(o.text, ::testing::Not(::testing::HasSubstr("agree within the noise")));
}

// Rows without a number are told, of a table as of a record over time.
TEST_F(Outputs, RowsOfATableWithoutANumberAreTold) {
  Write("table.csv", "x,F\n0,1\n1e-5,nan\n2e-5,inf\n3e-5,1\n");
  Write("t.toml",
        "rig = \"rig.toml\"\n[[record]]\nkind = \"static\"\ndata = \"table.csv\"\n"
        "[record.channels]\n\"A.x\" = \"x\"\n\"A.fx\" = \"F\"\n");
  const Outcome o = Ambrig("compare t.toml --json t.json");
  EXPECT_EQ(o.exit, 0) << o.text;
  // No record is unseen: its error is unknown, not zero.
  EXPECT_THAT(ReadText(folder_ / "t.json"), ::testing::HasSubstr("\"ratio_validate\": null"));
  EXPECT_THAT(o.text, ::testing::HasSubstr("table.csv: A.fx: 2 of 4 rows left out (no number)"));
}

}  // namespace
}  // namespace ambrig
