// ambrig new: what it writes is read again by the commands, it says what it took for what, and it
// never overwrites another's files.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "rig/rig_file.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

const std::string kExamplesOfNew = AMBRIG_SOURCE_DIR "/examples/new/";

class NewBench : public CliFolder {};

/// Lines of the terminal joined again.
std::string Unwrapped(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (const char next = c == '\n' ? ' ' : c; next != ' ' || out.empty() || out.back() != ' ')
      out += next;
  return out;
}

// The magnet's data sheet and one record of it: mapped, held at its distance, compared.
TEST_F(NewBench, FromTenNumbersAndARecordToACase) {
  const Outcome o = Ambrig("new --answers " + kExamplesOfNew + "ball.toml -o ball");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("2401 rows at 200 Hz"));
  EXPECT_THAT(o.text, HasSubstr("M.i1    i1_A"));
  EXPECT_THAT(o.text, HasSubstr("M.d1    u1_duty"));
  EXPECT_THAT(o.text, HasSubstr("z_m is taken as the distance from the magnet"));
  EXPECT_THAT(o.text, HasSubstr("coils driven by: measured duties"));
  EXPECT_THAT(o.text, HasSubstr("error over noise, all records"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "ball/compare.html"));
  const std::string scenario = ReadText(folder_ / "ball/record.toml");
  // z_m stands at 10.32 mm before a magnet whose working gap is 10 mm.
  EXPECT_THAT(scenario, HasSubstr("position = { M = [-0.0003"));
  EXPECT_THAT(scenario, HasSubstr("port = \"duty\""));
  EXPECT_EQ(Ambrig("compare ball/case.toml").exit, 0);  // the files are there to go on with
}

// The ball lies at the magnet and shifts by half a millimetre: its gap moves as measured, but the
// currents do not carry it, so that nothing is said of a free ball.
TEST_F(NewBench, ABodyThatLiesOnSomethingIsNotFree) {
  Write("ball.toml",
        Replaced(ReadText(kExamplesOfNew + "ball.toml"), "../mls2em/data/inductance_em1_05.csv",
                 AMBRIG_SOURCE_DIR "/examples/mls2em/data/inductance_em1_11.csv"));
  const Outcome o = Ambrig("new --answers ball.toml -o ball --only-files");
  ASSERT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("the measured currents pull with 4.57 times the weight"));
  EXPECT_THAT(o.text, HasSubstr("\nnow: ambrig compare ball/case.toml\n"));
  const std::string text = ReadText(folder_ / "ball/case.toml");
  EXPECT_THAT(text, HasSubstr("imposed = \"motion\""));
  EXPECT_THAT(text, HasSubstr("column = \"z_m\", unit = \"m\", gain = -1.0, offset = 0.01"));
  EXPECT_EQ(text.find("imposed = \"currents\""), std::string::npos);
}

// A levitated ball: its own run as the record. It hangs above the centre for half a second, x by
// its name; the ball under the measured currents leaves nothing but noise. (The coils do not: every
// second duty was not logged.)
TEST_F(NewBench, ALevitatedBodyIsMovedByItsCurrents) {
  Write("numbers.toml",
        Replaced(ReadText(kExamplesOfNew + "ball.toml"), "record = ", "# record = "));
  ASSERT_EQ(Ambrig("new --answers numbers.toml --only-files -o made").exit, 0);
  ASSERT_EQ(Ambrig("run made/levitation.toml --csv --no-report --out made").exit, 0);
  const Outcome o = Ambrig("new --answers numbers.toml --record made/levitation.csv -o seen");
  ASSERT_EQ(o.exit, 0) << o.text;
  EXPECT_EQ(o.text.find("pull with"), std::string::npos) << o.text;
  EXPECT_THAT(Unwrapped(o.text),
              HasSubstr("carry 1 times the weight: taken as a body that hovers"));
  EXPECT_THAT(Unwrapped(o.text), HasSubstr("1000 rows a second, 2000 switching periods a second"));
  const std::string text = ReadText(folder_ / "seen/case.toml");
  EXPECT_THAT(text, HasSubstr("imposed = \"motion\""));
  EXPECT_THAT(text, HasSubstr("imposed = \"currents\""));
  ASSERT_EQ(Ambrig("compare seen/case.toml --json compare.json").exit, 0);
  const auto records = nlohmann::json::parse(ReadText(folder_ / "compare.json"))["records"];
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[1]["scenario"], "the rotor under measured currents");
  EXPECT_LT(records[1]["ratio"].get<double>(), 1.3);
}

// Currents read 1.4 times too large pull with twice the weight: neither surely free nor surely
// held. The user decides.
TEST_F(NewBench, ABodyInDoubtIsAskedFor) {
  Write("numbers.toml",
        Replaced(ReadText(kExamplesOfNew + "ball.toml"), "record = ", "# record = "));
  ASSERT_EQ(Ambrig("new --answers numbers.toml --only-files -o made").exit, 0);
  ASSERT_EQ(Ambrig("run made/levitation.toml --csv --no-report --out made").exit, 0);
  const std::string call =
      "new --answers numbers.toml --record made/levitation.csv --column M.i1=M.i1:A:1.42 "
      "--only-files ";
  const auto free = [&](const std::string& more, const std::string& folder) {
    const Outcome o = Ambrig(call + more + " -o " + folder);
    EXPECT_EQ(o.exit, 0) << o.text;
    if (more.empty()) {
      EXPECT_THAT(Unwrapped(o.text), HasSubstr("in doubt: the measured currents pull with 2"));
      EXPECT_THAT(Unwrapped(o.text), HasSubstr("that it hovers says --body free"));
    }
    return ReadText(folder_ / folder / "case.toml").find("imposed = \"currents\"") !=
           std::string::npos;
  };
  EXPECT_FALSE(free("", "doubt"));
  EXPECT_TRUE(free("--body free", "free"));
  EXPECT_FALSE(free("--body held", "held"));
  const Outcome o = Ambrig(call + "--body hangs");
  EXPECT_EQ(o.exit, 2);
  EXPECT_THAT(o.text, HasSubstr("body = \"hangs\", allowed: free, held"));
}

// A logger with a fifth of the controller's rate: what was commanded between its rows is nowhere,
// so that nothing of the coils is compared.
TEST_F(NewBench, CommandsBetweenTheRowsAreMissed) {
  Write("numbers.toml",
        Replaced(ReadText(kExamplesOfNew + "ball.toml"), "record = ", "# record = "));
  ASSERT_EQ(Ambrig("new --answers numbers.toml --only-files -o made").exit, 0);
  ASSERT_EQ(Ambrig("run made/levitation.toml --csv --no-report --out made").exit, 0);
  std::istringstream in(ReadText(folder_ / "made/levitation.csv"));
  std::string log, line;
  for (int k = -1; std::getline(in, line); ++k)
    if (k < 0 || k % 5 == 0) log += line + "\n";
  Write("log.csv", log);
  const Outcome o = Ambrig("new --answers numbers.toml --record log.csv -o seen --only-files");
  ASSERT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(Unwrapped(o.text),
              HasSubstr("the record has 200 rows a second and the controller commands 1000"));
  const std::string text = ReadText(folder_ / "seen/case.toml");
  EXPECT_EQ(text.find("imposed = \"motion\""), std::string::npos);
  EXPECT_NE(text.find("imposed = \"currents\""), std::string::npos);
}

// Words for a place: the body is held where a column that stands still says so.
TEST_F(NewBench, AStrokeAGapAndADistanceArePlaces) {
  for (const char* name : {"stroke_mm", "gap_mm", "distance (mm)"}) {
    std::string log = std::string("t,") + name + ",i1_A,u1_duty\n";
    for (int k = 0; k < 50; ++k) log += std::to_string(k * 0.005) + ",4.0,0.4,0.2\n";
    Write("log.csv", log);
    Write("ball.toml", Replaced(ReadText(kExamplesOfNew + "ball.toml"),
                                "../mls2em/data/inductance_em1_05.csv", "log.csv"));
    const Outcome o = Ambrig("new --answers ball.toml -o ball --only-files --force");
    ASSERT_EQ(o.exit, 0) << o.text;
    EXPECT_THAT(ReadText(folder_ / "ball/record.toml"), HasSubstr("position = { M = [0.006,"))
        << name;
  }
}

// A column of words beside the numbers, and a table without times.
TEST_F(NewBench, WordsAreLeftOutAndTablesAreNamed) {
  std::string log = "t,state,i1_A,u1_duty\n";
  for (int k = 0; k < 50; ++k) log += std::to_string(k * 0.005) + ",pushed in,0.4,0.2\n";
  Write("log.csv", log);
  Write("ball.toml", Replaced(ReadText(kExamplesOfNew + "ball.toml"),
                              "../mls2em/data/inductance_em1_05.csv", "log.csv"));
  const Outcome o = Ambrig("new --answers ball.toml -o ball --only-files");
  ASSERT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(Unwrapped(o.text), HasSubstr("state holds words, left out"));
  Write("log.csv", "stroke_mm,L_mH\n0,2\n1,1\n");
  const Outcome table = Ambrig("new --answers ball.toml -o table --only-files");
  EXPECT_EQ(table.exit, 2);
  EXPECT_EQ(table.lines(), 1) << table.text;
  EXPECT_THAT(table.text, HasSubstr("a [[record]] of a case with kind = \"static\""));
}

// A body that comes to lie at the magnet reads zero and a little noise below: a distance all the
// same.
TEST_F(NewBench, ADistanceMayComeDownToZero) {
  std::string log = "t,z_m,i1_A,u1_duty\n";
  for (int k = 0; k < 400; ++k)
    log += std::to_string(k * 0.005) + "," +
           std::to_string(std::max(4e-3 - 2e-5 * k, k % 2 == 0 ? 1e-6 : -1e-6)) + ",0.4,0.2\n";
  Write("log.csv", log);
  Write("ball.toml", Replaced(ReadText(kExamplesOfNew + "ball.toml"),
                              "../mls2em/data/inductance_em1_05.csv", "log.csv"));
  const Outcome o = Ambrig("new --answers ball.toml -o ball --only-files");
  ASSERT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("z_m is taken as the distance from the magnet, x = 0.01 m - z_m"));
  EXPECT_THAT(ReadText(folder_ / "ball/case.toml"), HasSubstr("gain = -1.0, offset = 0.01"));
}

// For a page that asks: the questions of every template; what was written and which columns were
// taken.
TEST_F(NewBench, TellsItsQuestionsAndWhatItWroteAsJson) {
  EXPECT_EQ(Ambrig("new --list --json q.json").exit, 0);
  const auto q = nlohmann::json::parse(ReadText(folder_ / "q.json"));
  ASSERT_EQ(q["templates"].size(), 5u);
  const auto& mass = q["templates"][0]["numbers"][0];
  EXPECT_EQ(mass["key"], "mass");
  EXPECT_EQ(mass["unit"], "kg");
  EXPECT_TRUE(mass["fallback"].is_null());
  EXPECT_LT(mass["lo"], mass["hi"]);
  std::filesystem::copy_file(AMBRIG_SOURCE_DIR "/examples/mls2em/data/inductance_em1_05.csv",
                             folder_ / "log.csv");
  Write("ball.toml", Replaced(ReadText(kExamplesOfNew + "ball.toml"),
                              "../mls2em/data/inductance_em1_05.csv", "log.csv"));
  const Outcome o = Ambrig("new --answers ball.toml -o ball --only-files --json made.json");
  ASSERT_EQ(o.exit, 0) << o.text;
  const auto made = nlohmann::json::parse(ReadText(folder_ / "made.json"));
  EXPECT_EQ(made["files"], (nlohmann::json{"ball/rig.toml", "ball/record.toml", "ball/case.toml"}));
  bool current = false;
  for (const auto& c : made["columns"]) current |= c["channel"] == "M.i1" && c["column"] == "i1_A";
  EXPECT_TRUE(current) << made;
  // Bench and record may move together.
  EXPECT_THAT(ReadText(folder_ / "ball/case.toml"), HasSubstr("data = \"../log.csv\""));
}

// The weight is carried by i0 = (g_c + g) sqrt(2 m g/(L_0 g_c)).
TEST_F(NewBench, BiasOfOneAxisCarriesTheWeight) {
  const Outcome o = Ambrig("new --answers " + kExamplesOfNew + "ball.toml -o ball --only-files");
  EXPECT_EQ(o.exit, 0) << o.text;
  const RigParameters rig = ReadRig((folder_ / "ball/rig.toml").string());
  const double i0 = (0.008 + 0.010) * std::sqrt(2 * 0.0605 * 9.81 / (0.045 * 0.008));
  EXPECT_NEAR(rig.controller.bias_current, i0, 1e-3 * i0);  // written with four digits
  EXPECT_EQ(rig.rotor.mass, 0.0605);
}

struct Template {
  const char *name, *more;
};

class NewTemplates : public CliFolder, public ::testing::WithParamInterface<Template> {};

// Every template hovers with numbers of a small spindle; `run` fails when the orbit passes a
// quarter of the gap.
TEST_P(NewTemplates, Hover) {
  const std::string numbers =
      " --set mass=1.2 --set span=0.11 --set inertia_transverse=4e-3 --set turns=60 --set "
      "pole_area=8e-5 --set gap=3e-4 --set resistance=0.8 --set bus_voltage=24 --set i_max=4 ";
  const Outcome o =
      Ambrig("new --template " + std::string(GetParam().name) + numbers + GetParam().more);
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("max_orbit"));
  EXPECT_EQ(o.text.find("NOT MET"), std::string::npos) << o.text;
}

INSTANTIATE_TEST_SUITE_P(
    All, NewTemplates,
    ::testing::Values(Template{"two-axis", "--set bias_current=1"},
                      Template{"spindle", "--set bias_current=1"},
                      Template{"homopolar",
                               "--set magnet_mmf=800 --set magnet_length=4e-3 --set "
                               "magnet_area=3e-4"},
                      Template{"thrust",
                               "--set bias_current=1 --set thrust_turns=80 --set "
                               "thrust_area=3e-4 --set thrust_gap=4e-4 --set "
                               "thrust_bias=0.5"}));

// Asked one by one; a wrong answer is asked again, an empty one takes the standard.
TEST_F(NewBench, AsksForWhatIsMissing) {
  Write("answers.txt", "one-axis\n\n0.06\n-1\n0.01\n4.0\n0.11\n0.045\n0.008\n12\n3\n2000\n\n");
  const Outcome o = Ambrig("new --ask --only-files < answers.txt");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("gap = -1, allowed: 1e-05 to 1 m"));
  const RigParameters rig = ReadRig((folder_ / "bench/rig.toml").string());
  EXPECT_EQ(rig.rotor.mass, 0.06);
  EXPECT_EQ(rig.controller.rate, 1000);
  Write("short.txt", "one-axis\n\n0.06\n");
  const Outcome ended = Ambrig("new --ask -o other < short.txt");
  EXPECT_EQ(ended.exit, 2);
  EXPECT_THAT(ended.text, HasSubstr("the answers ended"));
}

TEST_F(NewBench, MistakesAreOneLine) {
  const auto says = [&](const std::string& arguments, const std::string& text) {
    const Outcome o = Ambrig("new " + arguments);
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_THAT(o.text, HasSubstr(text));
  };
  says("", "--template is missing");
  says("--template spindel", "template = \"spindel\", allowed: one-axis, two-axis, spindle");
  says("--template spindle --set mass=1", "missing span [m], inertia_transverse [kg m2]");
  says("--template spindle --set mass=heavy", "mass = heavy, allowed: 0.0001 to 100000 kg");
  says("--template spindle --set weight=1", "\"weight\", allowed: mass, span");
  Write("a.toml", "template = \"spindle\"\nmass = 1.0\nspam = 2\n");
  says("--answers a.toml", "spam");
}

TEST_F(NewBench, DoesNotOverwriteWhatIsNotItsOwn) {
  std::filesystem::create_directory(folder_ / "ball");
  Write("ball/rig.toml", "mine = true\n");
  const std::string call = "new --answers " + kExamplesOfNew + "ball.toml -o ball --only-files";
  EXPECT_EQ(Ambrig(call).exit, 2);
  EXPECT_EQ(ReadText(folder_ / "ball/rig.toml"), "mine = true\n");
  EXPECT_EQ(Ambrig(call + " --force").exit, 0);
  EXPECT_EQ(Ambrig(call).exit, 0);  // its own by now
}

}  // namespace
}  // namespace ambrig
