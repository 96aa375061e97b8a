// What commands print: units beside every number, words instead of the program's own terms, 80
// columns; and that what `redistribute` prints is what a run does.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/record/hdf5.h"
#include "tests/cli/work_folder.h"

namespace ambrig {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class TerminalText : public WorkFolder {
 protected:
  static void ExpectEightyColumns(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  }
  /// Scenario and record of this seed, in seen/.
  void Measure(const std::string& name, int seed) const {
    Write(name + ".toml", Replaced(ScenarioText("seed = " + std::to_string(seed) + "\n"),
                                   "duration = 0.01", "duration = 0.02"));
    ASSERT_EQ(Ambrig("run " + name + ".toml --quiet --no-report --csv --out seen").exit, 0);
  }
};

TEST_F(TerminalText, ARunHasUnitsAndWords) {
  Write("open.toml",
        ScenarioText("[[fault]]\ntime = 0.003\ntarget = \"A.coil3\"\nkind = \"open\"\n[expect]\n"
                     "detected_within = 0.002\nmax_orbit = 4e-5\n"));
  const Outcome o = Ambrig("run open.toml --no-report --out out");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, ContainsRegex("detected_within +wanted <= 2 ms +got [0-9.]+ ms"));
  EXPECT_THAT(o.text, ContainsRegex("max_orbit +wanted <= 40 um +got [0-9.]+ um"));
  EXPECT_THAT(o.text, HasSubstr("switching periods of healthy coils"));
  EXPECT_THAT(o.text, HasSubstr("exact (force law as when healthy)"));
  EXPECT_THAT(o.text, ContainsRegex("computed at +[0-9.]+ x real time"));
  EXPECT_THAT(o.text, Not(HasSubstr("coil-periods")));
  ExpectEightyColumns(o.text);
}

// Nothing is fitted by compare; a file is shown from its name's beginning.
TEST_F(TerminalText, CompareHasFittedNothing) {
  Measure("first", 1);
  Measure("second", 2);
  Write("two.toml",
        "rig = \"rig.toml\"\n[[record]]\nscenario = \"first.toml\"\ndata = \"seen/first.h5\"\n"
        "[[record]]\nscenario = \"second.toml\"\ndata = \"seen/second.h5\"\nuse = \"validate\"\n");
  const Outcome o = Ambrig("compare two.toml");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, ContainsRegex("\nfirst.h5 +t +[0-9.]+"));
  EXPECT_THAT(o.text, HasSubstr("(to be fitted "));
  EXPECT_THAT(o.text, Not(HasSubstr("(fitted ")));
  ExpectEightyColumns(o.text);
}

// One sample that cannot be is told with its mend, however far off it is.
TEST_F(TerminalText, AnAbsurdSampleIsADataNote) {
  Measure("first", 1);
  std::string rows = ReadText(folder_ / "seen/first.csv");
  std::size_t at = 0;
  for (int line = 0; line < 100; ++line) at = rows.find('\n', at) + 1;
  at = rows.find(',', at) + 1;  // the column after the time
  const std::string name = rows.substr(rows.find(',') + 1, 3);
  for (const char* value : {"1.0", "1e308"}) {
    std::string spoilt = rows;
    Write("spoilt.csv", spoilt.replace(at, rows.find(',', at) - at, value));
    Write("c1.toml",
          "rig = \"rig.toml\"\n[[record]]\nscenario = \"first.toml\"\ndata = \"spoilt.csv\"\n");
    const Outcome o = Ambrig("compare c1.toml --no-blocks");
    EXPECT_THAT(o.text, HasSubstr("data: spoilt.csv: " + name + " holds values that cannot be"));
    EXPECT_THAT(o.text, ContainsRegex("to mend it: leave_out"));
  }
}

// Zone D is said in the verdict; crossings that are damped too much to have a peak are no critical
// speeds; the reports of two rig.toml are two.
TEST_F(TerminalText, AnAnalysisSaysItsZonesAndOnlyTrueCriticals) {
  for (const char* name : {"one", "two"}) {
    std::filesystem::create_directory(folder_ / name);
    Write(std::string(name) + "/rig.toml", ReferenceRigText());
  }
  Outcome o;
  for (const char* name : {"one", "two"}) {
    o = Ambrig("analyze " + std::string(name) + "/rig.toml -o reports --json a.json");
    EXPECT_EQ(o.exit, 0) << o.text;
  }
  EXPECT_THAT(o.text, HasSubstr("sensitivity outside zones A and B: z (D)"));
  for (const char* file : {"one.rig.analysis.html", "one.rig.analysis.json",
                           "two.rig.analysis.html", "two.rig.analysis.json"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "reports" / file)) << file;
  std::size_t crossings = 0, peaks = 0, printed = 0;
  const auto json = nlohmann::json::parse(ReadText(folder_ / "a.json"));
  for (const auto& c : json["critical_speeds"]) {
    ++crossings;
    peaks += c["log_decrement"].get<double>() < 2 * std::acos(-1.0) ? 1 : 0;  // zeta of 0.71
  }
  for (std::size_t at = 0; (at = o.text.find("  critical speed ", at)) != std::string::npos; ++at)
    ++printed;
  EXPECT_GT(crossings, peaks) << "this rig does not test it";
  EXPECT_EQ(printed, peaks);
  ExpectEightyColumns(o.text);
}

TEST_F(TerminalText, ADesignHasUnits) {
  const Outcome o = Ambrig("design examples/design/small.toml -o study --no-report");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, ContainsRegex("load: orbit +[0-9.]+ um\n"));
  ExpectEightyColumns(o.text);
}

// "tells nothing from X" reads as if it told nothing.
TEST_F(TerminalText, APlanSaysWhatARecordTellsApart) {
  const Outcome o =
      Ambrig("plan rig.toml --learn side-pull@A cross-coupling@A --draws 0 -o p.toml");
  EXPECT_EQ(o.exit, 0) << o.text;
  const std::string words = std::regex_replace(o.text, std::regex("\\s+"), " ");
  EXPECT_THAT(words, HasSubstr("- tells side-pull at A from no effect with a probability of"));
  EXPECT_THAT(words, HasSubstr("- tells side-pull at A from cross-coupling at A with"));
  EXPECT_THAT(words, Not(HasSubstr("tells nothing")));
}

// The set-points of a run with these coils open are W of what is printed times (c0, vx, vy).
TEST_F(TerminalText, RedistributePrintsWhatRunsUse) {
  const Outcome printed = Ambrig("redistribute rig.toml --failed 1,2 --json w.json");
  ASSERT_EQ(printed.exit, 0) << printed.text;
  EXPECT_THAT(printed.text, HasSubstr("W (rows: coils; i = W [c0, vx, vy]')"));
  const auto json = nlohmann::json::parse(ReadText(folder_ / "w.json"));
  Eigen::Matrix<double, 8, 3> W;
  for (int j = 0; j < 8; ++j)
    for (int c = 0; c < 3; ++c) W(j, c) = json["sets"][0]["W"][j][c];
  std::string faults;
  for (const char* coil : {"A.coil1", "A.coil2"})
    faults += "[[fault]]\ntime = 0.005\ntarget = \"" + std::string(coil) + "\"\nkind = \"open\"\n";
  Write("open.toml", Replaced(ScenarioText(faults), "duration = 0.01", "duration = 0.05"));
  ASSERT_EQ(Ambrig("run open.toml --quiet --no-report --out .").exit, 0);
  const Record record = ReadHdf5((folder_ / "open.h5").string());
  Eigen::Matrix<double, 8, 1> i;
  for (int j = 0; j < 8; ++j) i[j] = record.Find("A.s" + std::to_string(j + 1))->samples.back();
  const Eigen::Matrix<double, 8, 1> rest = i - W.col(0) * json["c0"].get<double>();
  const Eigen::Vector2d v = W.rightCols<2>().colPivHouseholderQr().solve(rest);
  EXPECT_GT(i.norm(), 2);
  EXPECT_LT((rest - W.rightCols<2>() * v).norm(), 1e-6 * i.norm());  // digits of the record
}

}  // namespace
}  // namespace ambrig
