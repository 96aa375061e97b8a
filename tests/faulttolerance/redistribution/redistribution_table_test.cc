#include "faulttolerance/redistribution/redistribution_table.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>

#include "faulttolerance/redistribution/redistribution_json.h"
#include "tests/faulttolerance/redistribution_reference.h"

namespace ambrig {
namespace {

RedistributionProblem ProblemOf(const char* winding = "NSNSNSNS") {
  return MakeRedistributionProblem(std::numbers::pi / 8, winding);
}

/// A directory of its own that goes away with the test.
class CacheDirectory {
 public:
  CacheDirectory() {
    char name[] = "/tmp/ambrig-table-XXXXXX";
    path_ = mkdtemp(name);
  }
  ~CacheDirectory() { std::filesystem::remove_all(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string Contents(const std::string& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

int Files(const std::string& directory) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(directory)) ++count;
  return count;
}

TEST(BearingSymmetry, GroupsOfBothWindings) {
  EXPECT_EQ(FindSymmetries(ProblemOf()).size(), 16u);
  EXPECT_EQ(FindSymmetries(ProblemOf("NNSSNNSS")).size(), 8u);
  EXPECT_EQ(FindSymmetries(ProblemOf("NNNNNNNS")).size(),
            2u);  // identity and one mirror
}

TEST(BearingSymmetry, MappedDistributionSolvesTheMappedSet) {
  RedistributionProblem p = ProblemOf("NNSSNNSS");
  p.turns_left << 0, 1, 0.5, 1, 1, 0, 1, 1;
  const Distribution d = SolveDistribution(p);
  for (const BearingSymmetry& g : FindSymmetries(p)) {
    RedistributionProblem q = p;
    q.turns_left = Mapped(g, p.turns_left);
    const Distribution image = Describe(q, d.cls, Mapped(g, d.W));
    EXPECT_LT(image.residual, 1e-12);
    EXPECT_NEAR(image.rho, d.rho, 1e-12);
    EXPECT_LT((MappedBack(g, Mapped(g, d.W)) - d.W).norm(), 1e-14);
    EXPECT_NEAR(LargestEigenvalue(image.stiffness) / LargestEigenvalue(d.stiffness), 1, 1e-12);
  }
}

/// docs/theory/published_values.md 2.2: the algebraic classes of all 255 sets.
TEST(RedistributionTable, CountsOfAllSets) {
  for (const char* winding : {"NSNSNSNS", "NNSSNNSS"}) {
    const CacheDirectory directory;
    DistributionOptions few;  // the classes do not depend on it
    few.starts = 16;
    const RedistributionTable table(ProblemOf(winding), directory.path(), few);
    std::map<std::size_t, std::map<SolvabilityClass, int>> count;
    for (const std::vector<int>& failed : AllFailureSets()) {
      const Distribution d = table.Lookup(failed);
      ++count[failed.size()][d.cls];
      for (const int coil : failed) EXPECT_TRUE(d.W.row(coil - 1).isZero());
      if (failed.size() <= 2) {
        EXPECT_LT(d.residual, 1e-12);
      }
      if (failed.size() <= 2) {
        EXPECT_TRUE(d.unipolar);
      }
    }
    using enum SolvabilityClass;
    EXPECT_EQ(count[1], (std::map<SolvabilityClass, int>{{kExact, 8}}));
    EXPECT_EQ(count[2], (std::map<SolvabilityClass, int>{{kExact, 28}}));
    EXPECT_EQ(count[3], (std::map<SolvabilityClass, int>{{kExact, 56}}));
    EXPECT_EQ(count[4], (std::map<SolvabilityClass, int>{{kExact, 6}, {kLinearised, 64}}));
    EXPECT_EQ(count[5], (std::map<SolvabilityClass, int>{{kLinearised, 32}, {kNone, 24}}));
    EXPECT_EQ(count[6], (std::map<SolvabilityClass, int>{{kNone, 28}}));
    EXPECT_EQ(count[7], (std::map<SolvabilityClass, int>{{kNone, 8}}));
    EXPECT_EQ(count[8], (std::map<SolvabilityClass, int>{{kNone, 1}}));
    // Only one set of each orbit of the symmetries is solved (all of them cold took 24 s): with 16
    // symmetries these are the 29 bracelets of eight beads in two colours that are not all healthy.
    const auto solved = nlohmann::json::parse(Contents(table.cache_file()))["entries"].size();
    if (FindSymmetries(ProblemOf(winding)).size() == 16) {
      EXPECT_EQ(solved, 29u);
    }
    EXPECT_LT(solved, 60u);
  }
}

/// With the capacity policy W has what its class promises: all twelve equations, or the first six.
TEST(RedistributionTable, CapacityPolicyKeepsThePromiseOfTheClass) {
  DistributionOptions options;
  options.policy = DistributionPolicy::kCapacity;
  const RedistributionTable table(ProblemOf(), {}, options);
  for (const std::vector<int>& failed : AllFailureSets()) {
    const Distribution d = table.Lookup(failed);
    RedistributionProblem p = ProblemOf();
    for (const int coil : failed) p.turns_left[coil - 1] = 0;
    const auto errors = EquationErrors(MakeForceForms(p), d.W);
    if (d.cls == SolvabilityClass::kExact) {
      EXPECT_LT(d.residual, 1e-9);
    }
    if (d.cls != SolvabilityClass::kNone) {
      EXPECT_LT(errors.head<6>().cwiseAbs().maxCoeff(), 1e-9);
    }
    if (d.cls == SolvabilityClass::kLinearised) {
      EXPECT_GT(d.residual, 1e-3);
    }
  }
}

TEST(RedistributionTable, PartialShortBetweenGridPointsIsExact) {
  const RedistributionTable table(ProblemOf());
  CoilVector turns_left = CoilVector::Ones();
  for (const double s : {0.013, 0.37, 0.512, 0.981}) {
    turns_left[5] = 1 - s;
    const Distribution d = table.Lookup(turns_left);
    EXPECT_LT(d.residual, 1e-12) << s;
    EXPECT_GT(d.rho, 0.7) << s;
    EXPECT_TRUE(d.unipolar) << s;
  }
  EXPECT_THROW(table.Lookup(std::vector<int>{9}), std::logic_error);
}

TEST(RedistributionTable, CacheGivesTheSameBitsAndSurvivesDamage) {
  const CacheDirectory directory;
  const std::vector<int> failed = {2, 5};
  const RedistributionTable first(ProblemOf(), directory.path());
  const DistributionMatrix W = first.Lookup(failed).W;
  const std::string file = first.cache_file(), good = Contents(file);
  ASSERT_FALSE(good.empty());
  EXPECT_EQ(Files(directory.path()), 1);  // no temporary file left

  EXPECT_EQ(RedistributionTable(ProblemOf(), directory.path()).Lookup(failed).W, W);

  std::string wrong_number = good;  // still JSON, but not a solution any more
  const std::size_t digit = wrong_number.find("0.", wrong_number.find("\"W\"")) + 3;
  wrong_number[digit] = wrong_number[digit] == '5' ? '6' : '5';
  for (const std::string& bad :
       {std::string(), good.substr(0, good.size() / 2), std::string("[1, 2"), std::string("[]"),
        std::string(R"({"version": -1, "entries": []})"),
        std::string(R"({"version": 2, "entries": [{"turns": "x"}]})"), wrong_number}) {
    std::ofstream(file) << bad;
    EXPECT_EQ(RedistributionTable(ProblemOf(), directory.path()).Lookup(failed).W, W);
    EXPECT_EQ(Contents(file), good);
  }
}

// Copies and texts of JSON are recursive: a file of brackets ended the program.
TEST(RedistributionTable, ValuesDeepInsideOneAnotherAreLeftOut) {
  const CacheDirectory directory;
  const std::vector<int> failed = {2, 5};
  const RedistributionTable first(ProblemOf(), directory.path());
  const DistributionMatrix W = first.Lookup(failed).W;
  const std::string good = Contents(first.cache_file()), inside(200000, '['), out(200000, ']');
  std::ofstream(first.cache_file())
      << R"({"version": 3, "entries": [{"checksum": "", "W": )" + inside + out + "}]}";
  EXPECT_EQ(RedistributionTable(ProblemOf(), directory.path()).Lookup(failed).W, W);
  EXPECT_EQ(Contents(first.cache_file()), good);
}

// The residual tells that W was edited, but neither the class nor the capacity.
TEST(RedistributionTable, AnEditedClassOrCapacityIsMadeAnew) {
  const CacheDirectory directory;
  const std::vector<int> failed = {2, 5};
  const RedistributionTable first(ProblemOf(), directory.path());
  const SolvabilityClass cls = first.Lookup(failed).cls;
  const double flux = first.FluxCapacity(failed);
  const auto good = nlohmann::json::parse(Contents(first.cache_file()));
  ASSERT_EQ(good["entries"].size(), 1u);
  ASSERT_EQ(good["entries"][0]["flux"], flux);
  for (const auto& [key, value] :
       {std::pair{"class", nlohmann::json("linearised")}, {"flux", nlohmann::json(2 * flux)}}) {
    nlohmann::json edited = good;
    edited["entries"][0][key] = value;
    std::ofstream(first.cache_file()) << edited.dump(1);
    const RedistributionTable again(ProblemOf(), directory.path());
    EXPECT_EQ(again.Lookup(failed).cls, cls) << key;
    EXPECT_EQ(again.FluxCapacity(failed), flux) << key;
  }
}

TEST(RedistributionTable, OtherProblemsHaveOtherFilesAndNoDirectoryIsNoError) {
  RedistributionProblem other = ProblemOf();
  other.i_max = 5;
  EXPECT_NE(RedistributionTable(ProblemOf(), "/tmp/x").cache_file(),
            RedistributionTable(other, "/tmp/x").cache_file());
  const RedistributionTable table(ProblemOf(), "/proc/no/such/place");
  EXPECT_LT(table.Lookup(std::vector<int>{1, 3, 5, 7}).residual, 1e-12);
}

TEST(RedistributionJson, HasTheKeysOfTheFormat) {
  DistributionOptions options;
  options.policy = DistributionPolicy::kCapacity;
  const RedistributionTable table(ProblemOf(), {}, options);
  const nlohmann::json root = RedistributionJson("A", table, {{1, 2, 5, 6}});
  EXPECT_EQ(root.size(), 4u);
  EXPECT_EQ(root.at("bearing"), "A");
  EXPECT_NEAR(root.at("k").get<double>(), 16.0, 1e-3);
  EXPECT_EQ(root.at("c0"), 2.0);
  const nlohmann::json& set = root.at("sets").at(0);
  EXPECT_EQ(set.size(), 7u);
  EXPECT_EQ(set.at("failed"), (std::vector<int>{1, 2, 5, 6}));
  EXPECT_EQ(set.at("class"), "exact");
  EXPECT_EQ(set.at("W").size(), 8u);
  EXPECT_EQ(set.at("W").at(0), (std::vector<double>{0, 0, 0}));
  EXPECT_LT(set.at("residual").get<double>(), 1e-9);
  EXPECT_GT(set.at("rho").get<double>(), 0);
  EXPECT_TRUE(set.at("unipolar").get<bool>());
  EXPECT_GE(set.at("capacity").at("flux").get<double>(), 0.352);
  EXPECT_GE(set.at("capacity").at("current").get<double>(), 0.332);
}

}  // namespace
}  // namespace ambrig
