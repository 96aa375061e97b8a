// What a study file says arrives once, mistakes are one line each, and a whole study is the same
// points in the same order for any number of threads.
#include "design/study.h"

#include <gmock/gmock.h>

#include <atomic>
#include <cmath>

#include "core/base/errors.h"
#include "design/pareto.h"
#include "design/run_study.h"
#include "tests/cli/cli_run.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kText = R"(name = "two gains"
speeds = [0.0, 300.0]
[[candidate]]
name = "PID"
rig = "pid.toml"
[[candidate.variable]]
path = "controller.kp"
range = [3.0e5, 6.0e5]
scale = "log"
[[candidate.variable]]
paths = ["controller.kd", "bearings.Z.controller.kd"]
range = [500.0, 1500.0]
[[objective]]
of = "peak_sensitivity"
[[objective]]
of = "noise_force"
name = "effort"
[[limit]]
of = "settling_time"
at_most = 0.1
[search]
points = 5
seed = 3
)";

class StudyFile : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;

  void SetUp() override { testing::WriteBytes(folder_.File("pid.toml"), ReferenceRigText()); }
  Study Read(const std::string& text) const {
    testing::WriteBytes(folder_.File("study.toml"), text);
    return ReadStudy(folder_.File("study.toml"));
  }
  std::string Mistake(const std::string& from, const std::string& to) const {
    const std::string text = Replaced(kText, from, to);
    EXPECT_NE(text, kText) << from;
    return testing::ErrorText<InputError>([&] { Read(text); });
  }
};

TEST_F(StudyFile, IsReadAsWritten) {
  const Study s = Read(kText);
  EXPECT_EQ(s.name, "two gains");
  EXPECT_THAT(s.speeds, ElementsAre(0, 300));
  ASSERT_EQ(s.candidates.size(), 1u);
  const DesignCandidate& c = s.candidates[0];
  EXPECT_EQ(c.name, "PID");
  ASSERT_EQ(c.variables.size(), 2u);
  EXPECT_TRUE(c.variables[0].logarithmic);
  EXPECT_FALSE(c.variables[1].logarithmic);
  EXPECT_GE(c.variables[0].start, 3e5);  // the rig file's own
  EXPECT_THAT(c.variables[1].paths, ElementsAre("controller.kd", "bearings.Z.controller.kd"));
  ASSERT_EQ(s.figures.size(), 3u);
  EXPECT_EQ(s.figures[0].name, "peak_sensitivity");
  EXPECT_EQ(s.figures[1].name, "effort");
  EXPECT_FALSE(s.figures[2].objective);
  EXPECT_EQ(s.figures[2].at_most, 0.1);
  EXPECT_THAT(s.Objectives(), ElementsAre(0u, 1u));
  EXPECT_EQ(s.method, SearchMethod::kSweep);
  EXPECT_EQ(s.points, 5);
  EXPECT_EQ(s.seed, 3u);
  ASSERT_EQ(s.draws.size(), 1u);
  EXPECT_TRUE(s.draws[0].empty());  // the nominal one
}

TEST_F(StudyFile, MistakesAreNamedWithWhatIsAllowed) {
  EXPECT_THAT(Mistake("[[objective]]\nof = \"peak_sensitivity\"\n[[objective]]\nof = "
                      "\"noise_force\"\nname = \"effort\"\n",
                      ""),
              HasSubstr("objective: is missing"));
  EXPECT_THAT(Mistake("at_most = 0.1\n", ""),
              HasSubstr("at_most: is missing, allowed: a number in s"));
  EXPECT_THAT(Mistake("of = \"noise_force\"", "of = \"orbit\"\nscenario = \"load\""),
              HasSubstr("= \"load\", allowed: a [[scenario]] first"));
  EXPECT_THAT(Mistake("of = \"noise_force\"", "of = \"plane_orbit\"\nscenario = \"x\""),
              HasSubstr("scenario"));
  EXPECT_THAT(Mistake("speeds = [0.0, 300.0]", "speeds = []"), HasSubstr("1 to 20 speeds"));
  EXPECT_THAT(Mistake("speeds = [0.0, 300.0]", "speeds = [2.0e5]"), HasSubstr("-1e5 to 1e5"));
  EXPECT_THAT(Mistake("speeds = [0.0, 300.0]", "frequency_errors = [0.1, 0.7]"),
              HasSubstr("frequency_errors = 0.7, allowed: -0.5 to 0.5"));
  EXPECT_THAT(Mistake("range = [500.0, 1500.0]", "range = [500.0, 1500.0]\nvalues = [600.0]"),
              HasSubstr("either range = [low, high] or values"));
  EXPECT_THAT(Mistake("range = [500.0, 1500.0]", "values = [600.0, 700.0]"),
              HasSubstr("ranges and values mixed"));
  EXPECT_THAT(Mistake("range = [500.0, 1500.0]", "range = [500.0, 600.0]"),
              HasSubstr("inside its range [500, 600], where the search begins"));
  EXPECT_THAT(Mistake("seed = 3", "sead = 3"), HasSubstr("sead"));
  EXPECT_THAT(Mistake("[search]", "[spread]\ndraws = 2\nscale = 11.0\n[search]"),
              HasSubstr("spread.scale"));
}

TEST_F(StudyFile, NamesStandOnce) {
  const std::string twice =
      std::string(kText) + "[[candidate]]\nname = \"PID\"\nrig = \"pid.toml\"\n";
  EXPECT_THAT(testing::ErrorText<InputError>([&] { Read(twice); }),
              HasSubstr("= \"PID\" stands twice"));
}

// What a study's points mean hangs on every file that it names.
TEST_F(StudyFile, TheFingerprintIsOfAllFiles) {
  const std::string first = Read(kText).fingerprint;
  EXPECT_EQ(Read(kText).fingerprint, first);
  EXPECT_NE(Read(Replaced(kText, "seed = 3", "seed = 4")).fingerprint, first);
  testing::WriteBytes(folder_.File("pid.toml"), ReferenceRigText() + "# a comment\n");
  EXPECT_NE(Read(kText).fingerprint, first);
}

// Latin hypercube: each of n draws of a parameter in a stratum of its own; twice the scale, twice
// the deviates.
TEST_F(StudyFile, DrawsAreSpreadOverTheTolerances) {
  const auto with = [&](const char* scale) {
    return Read(Replaced(
                    kText, "[search]",
                    std::string("[spread]\ndraws = 8\nseed = 5\nscale = ") + scale + "\n[search]"))
        .draws;
  };
  const auto one = with("1.0"), two = with("2.0");
  ASSERT_EQ(one.size(), 9u);
  EXPECT_TRUE(one[0].empty());
  for (std::size_t k = 0; k < one[1].size(); ++k) {
    std::vector<int> stratum(8, 0);
    for (std::size_t d = 1; d < 9; ++d) {
      const double u = 0.5 * std::erfc(-one[d][k] / std::sqrt(2.0));
      ++stratum[static_cast<std::size_t>(std::min(7.0, std::floor(8 * u)))];
      EXPECT_NEAR(two[d][k], 2 * one[d][k], 1e-12);
    }
    EXPECT_THAT(stratum, ::testing::Each(1)) << k;
  }
}

StudyResult RunIn(const testing::TemporaryFolder& folder, const Study& s, const std::string& out,
                  int jobs) {
  StudyOptions o;
  o.folder = folder.File(out);
  o.jobs = jobs;
  return RunStudy(s, o);
}

TEST_F(StudyFile, ASweepIsTheSamePointsForAnyNumberOfThreads) {
  const Study s = Read(kText);
  const StudyResult one = RunIn(folder_, s, "one", 1), two = RunIn(folder_, s, "two", 2);
  ASSERT_EQ(one.points.size(), 6u);
  ASSERT_EQ(two.points.size(), 6u);
  std::vector<std::vector<double>> objectives;
  std::vector<std::size_t> feasible;
  for (std::size_t k = 0; k < 6; ++k) {
    const StudyPoint &p = one.points[k], &q = two.points[k];
    EXPECT_EQ(p.values, q.values);
    EXPECT_EQ(p.result.figures, q.result.figures);
    EXPECT_EQ(p.front, q.front);
    for (std::size_t v = 0; v < 2; ++v) {
      EXPECT_GE(p.values[v], s.candidates[0].variables[v].low);
      EXPECT_LE(p.values[v], s.candidates[0].variables[v].high);
    }
    EXPECT_EQ(p.feasible, std::isfinite(p.result.figures[0]) && p.result.figures[2] <= 0.1);
    if (p.feasible) {
      feasible.push_back(k);
      objectives.push_back({p.result.figures[0], p.result.figures[1]});
    }
  }
  EXPECT_EQ(one.points[0].values, (std::vector<double>{s.candidates[0].variables[0].start,
                                                       s.candidates[0].variables[1].start}));
  EXPECT_THAT(one.scales,
              ElementsAre(one.points[0].result.figures[0], one.points[0].result.figures[1]));
  // The front is the one of the feasible points.
  const std::vector<std::size_t> front = ParetoFront(objectives);
  for (std::size_t k = 0; k < feasible.size(); ++k)
    EXPECT_EQ(one.points[feasible[k]].front, std::count(front.begin(), front.end(), k) == 1) << k;
}

// The grid of values, the first one running fastest, after the rig file's own numbers.
TEST_F(StudyFile, ValuesAreTriedInAllCombinations) {
  std::string text =
      Replaced(kText, "range = [3.0e5, 6.0e5]\nscale = \"log\"", "values = [4.1e5, 5.1e5]");
  text = Replaced(text, "range = [500.0, 1500.0]", "values = [710.0, 910.0]");
  text = Replaced(text, "points = 5\n", "");
  const StudyResult r = RunIn(folder_, Read(text), "grid", 2);
  ASSERT_EQ(r.points.size(), 5u);
  EXPECT_THAT(r.points[1].values, ElementsAre(4.1e5, 710));
  EXPECT_THAT(r.points[2].values, ElementsAre(5.1e5, 710));
  EXPECT_THAT(r.points[3].values, ElementsAre(4.1e5, 910));
  EXPECT_THAT(r.points[4].values, ElementsAre(5.1e5, 910));
}

TEST_F(StudyFile, AStoppedStudyKeepsWhatItHas) {
  const Study s = Read(kText);
  std::atomic<bool> stop{false};
  StudyOptions o;
  o.folder = folder_.File("out");
  o.jobs = 1;
  o.stop = &stop;
  std::size_t done = 0;
  o.progress = [&](std::size_t points, std::size_t expected) {
    EXPECT_EQ(expected, 6u);
    done = points;
    stop = points == 2;
  };
  EXPECT_THROW(RunStudy(s, o), Interrupted);
  EXPECT_EQ(done, 2u);
  stop = false;
  std::size_t evaluated = 0;
  o.progress = [&](std::size_t, std::size_t) { ++evaluated; };
  EXPECT_EQ(RunStudy(s, o).points.size(), 6u);
  EXPECT_EQ(evaluated, 4u);  // the other two stood in the journal
}

}  // namespace
}  // namespace ambrig
