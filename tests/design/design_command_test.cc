/// ambrig design: same bytes for any number of jobs and after kill -9, every point again, mistakes
/// in one line.
#include <nlohmann/json.hpp>

#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

class Design : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    const std::string rig = ReferenceRigText();
    Write("pid.toml", rig);
    const auto begin = rig.find("[controller]"), end = rig.find("[bearings.A]");
    Write("lqg.toml", rig.substr(0, begin) +
                          "[controller]\nkind = \"lqg\"\nrate = 12500.0\nbias_current = 2.0\nf_max "
                          "= 60.0\nforce_weight = 10.0\n" +
                          rig.substr(end));
    Write("load.toml",
          "name = \"load\"\nrig = \"pid.toml\"\nduration = 0.02\n[[load]]\nplane = \"A\"\nforce = "
          "[15.0, 0.0]\nstart = 0.005\n");
    Write("study.toml", kStudy);
  }
  static constexpr const char* kStudy =
      "name = \"small\"\n[[candidate]]\nname = \"PID\"\nrig = "
      "\"pid.toml\"\n[[candidate.variable]]\npath = \"controller.kp\"\nrange = [3.0e5, 6.0e5]\n"
      "[[candidate]]\nname = \"LQG\"\nrig = \"lqg.toml\"\n[[candidate.variable]]\npath = "
      "\"controller.force_weight\"\nrange = [2.0, 40.0]\nscale = \"log\"\n"
      "[[scenario]]\nname = \"load\"\nfile = \"load.toml\"\n[[objective]]\nof = "
      "\"peak_sensitivity\"\n[[objective]]\nof = \"orbit\"\nscenario = \"load\"\n"
      "[[limit]]\nof = \"drop\"\nscenario = \"load\"\nat_most = 0.0\n[search]\npoints = "
      "3\n[spread]\ndraws = 1\n";
  static std::string WithSearch(const std::string& search) {
    return Replaced(kStudy, "[search]\npoints = 3\n", search);
  }
};

TEST_F(Design, SameBytesForAnyJobsAndAfterBeingKilled) {
  EXPECT_EQ(Ambrig("design study.toml -o one --jobs 1 --no-report").exit, 0);
  const std::string table = ReadText(folder_ / "one/table.csv"),
                    json = ReadText(folder_ / "one/study.json");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 2 * 4);
  EXPECT_EQ(Ambrig("design study.toml -o two --jobs 2 --no-report").exit, 0);
  EXPECT_EQ(ReadText(folder_ / "two/table.csv"), table);
  EXPECT_EQ(ReadText(folder_ / "two/study.json"), json);
  // Killed when a few points are there: the rest is done, nothing twice.
  Shell("cd " + folder_.string() + " && (" + AMBRIG_BINARY +
        " design study.toml -o three --jobs 1 --no-report & pid=$!; while [ $(cat "
        "three/journal.txt 2>/dev/null | wc -l) -lt 4 ]; do sleep 0.02; "
        "kill -0 $pid 2>/dev/null || break; done; kill -9 $pid; wait $pid)");
  const std::string cut = ReadText(folder_ / "three/journal.txt");
  EXPECT_GE(std::count(cut.begin(), cut.end(), '\n'), 3);
  Write("three/journal.txt", cut.substr(0, cut.size() - 5));  // and the disk lost some
  EXPECT_EQ(Ambrig("design study.toml -o three --jobs 2 --no-report").exit, 0);
  EXPECT_EQ(ReadText(folder_ / "three/table.csv"), table);
  const std::string whole = ReadText(folder_ / "three/journal.txt");
  EXPECT_EQ(whole.find(cut.substr(0, cut.find('\n', cut.find('\n') + 1))), 0u);
}

TEST_F(Design, APointAgain) {
  ASSERT_EQ(Ambrig("design study.toml -o out --no-report").exit, 0);
  const auto study = nlohmann::json::parse(ReadText(folder_ / "out/study.json"));
  ASSERT_FALSE(study["front"].empty());
  const Outcome o = Ambrig("design study.toml -o out --no-report --point 6 --json p.json");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_NE(o.text.find("equal to the study's figures"), std::string::npos) << o.text;
  const auto point = nlohmann::json::parse(ReadText(folder_ / "p.json"));
  EXPECT_EQ(point["candidate"], "LQG");
  EXPECT_EQ(point["figures"], study["points"][6]["figures"]);
  // What it wrote is a rig and a scenario like any other.
  EXPECT_EQ(Ambrig("run out/point_6/load.toml --quiet --no-report --out again").exit, 0);
  const auto run = nlohmann::json::parse(ReadText(folder_ / "again/load.json")),
             first = nlohmann::json::parse(ReadText(folder_ / "out/point_6/load.json"));
  EXPECT_EQ(run["metrics"]["max_orbit"], first["metrics"]["max_orbit"]);
  EXPECT_EQ(Ambrig("design study.toml -o out --point 99").exit, 2);
}

// The search finds a better compromise than its start, keeps to the number of evaluations, and is
// the same again.
TEST_F(Design, Optimises) {
  Write("study.toml",
        WithSearch("[search]\nmethod = \"optimise\"\ndirections = 2\nevaluations = 8\n"));
  ASSERT_EQ(Ambrig("design study.toml -o a --jobs 2 --no-report").exit, 0);
  ASSERT_EQ(Ambrig("design study.toml -o b --jobs 1 --no-report").exit, 0);
  EXPECT_EQ(ReadText(folder_ / "a/table.csv"), ReadText(folder_ / "b/table.csv"));
  const auto study = nlohmann::json::parse(ReadText(folder_ / "a/study.json"));
  EXPECT_LE(study["points"].size(), 2u * (1 + 2 * 8));
  double best[2] = {1e9, 1e9}, start[2] = {0, 0};
  for (const auto& p : study["points"]) {
    const int c = p["candidate"] == "PID" ? 0 : 1;
    const double s = p["figures"]["peak_sensitivity"].is_null()
                         ? 1e9
                         : p["figures"]["peak_sensitivity"].get<double>();
    if (start[c] == 0) start[c] = s;
    best[c] = std::min(best[c], s);
  }
  EXPECT_LT(best[0] + best[1], start[0] + start[1]);
}

TEST_F(Design, ReportStandsAlone) {
  ASSERT_EQ(Ambrig("design study.toml -o out").exit, 0);
  const std::string html = ReadText(folder_ / "out/report.html");
  for (const char* part : {"Comparison of the candidates", "Pareto front",
                           "Responses of the points shown", "Pareto-optimal points"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

TEST_F(Design, AnUnstablePointIsAPoint) {
  Write("study.toml",
        Replaced(Replaced(kStudy, "range = [3.0e5, 6.0e5]", "values = [1.0e4, 4.0e5]"),
                 "range = [2.0, 40.0]\nscale = \"log\"", "values = [5.0]"));
  ASSERT_EQ(Ambrig("design study.toml -o out --no-report").exit, 0);
  const auto study = nlohmann::json::parse(ReadText(folder_ / "out/study.json"));
  EXPECT_TRUE(study["points"][1]["figures"]["peak_sensitivity"].is_null());
  EXPECT_EQ(study["points"][1]["meets_limits"], false);
  EXPECT_NE(std::string(study["points"][1]["note"]).find("unstable"), std::string::npos);
}

struct Mistake {
  std::string from, to, said;
};

TEST_F(Design, MistakesInOneLine) {
  for (const Mistake& m : std::vector<Mistake>{
           {"controller.kp", "controller.kq", "controller.kq"},
           {"of = \"peak_sensitivity\"", "of = \"peek\"", "peak_sensitivity"},
           {"scenario = \"load\"\n[[limit]]", "scenario = \"lod\"\n[[limit]]", "allowed: load"},
           {"range = [3.0e5, 6.0e5]", "range = [6.0e5, 3.0e5]", "low < high"},
           {"range = [2.0, 40.0]", "range = [-2.0, 40.0]", "above 0"},
           {"at_most = 0.0", "at_mots = 0.0", "at_mo"},
           {"rig = \"lqg.toml\"", "rig = \"lq.toml\"", "lq.toml"},
           {"draws = 1", "draws = 0", "allowed: 1"},
           {"range = [3.0e5, 6.0e5]", "range = [-3.0e13, 6.0e5]", "makes no rig"}}) {
    Write("study.toml", Replaced(kStudy, m.from, m.to));
    const Outcome o = Ambrig("design study.toml -o out --no-report");
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_NE(o.text.find(m.said), std::string::npos) << o.text;
  }
  Write("study.toml", kStudy);
  ASSERT_EQ(Ambrig("design study.toml -o out --no-report").exit, 0);
  Write("study.toml", Replaced(kStudy, "small", "changed"));
  const Outcome o = Ambrig("design study.toml -o out --no-report");
  EXPECT_EQ(o.exit, 2);
  EXPECT_NE(o.text.find("holds another study"), std::string::npos) << o.text;
}

}  // namespace
}  // namespace ambrig
