// ambrig detectors: curves against hand-made rows, ranking, same bytes for any jobs, resuming, bad
// input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "campaign/detector_curves.h"
#include "core/math/noise.h"
#include "nlohmann/json.hpp"
#include "tests/campaign/campaign_folder.h"

namespace ambrig::testing {
namespace {

const std::string kSmall =
    std::string(AMBRIG_SOURCE_DIR) + "/scenarios/studies/detectors_small.toml";

Row MakeRow(std::size_t run, std::vector<std::string> cells) {
  cells.insert(cells.begin(), std::to_string(run));
  return RowOfCells(run, cells);
}

TEST(DetectorCurves, OfRowsMadeByHand) {
  DetectorStudy study = ReadDetectorStudy(kSmall);
  study.detectors.resize(1);
  study.budget = 0.3;
  Rows rows;
  // Ten windows at level 10, 6 at 20, 3 at 30, 1 at 40: shares at or above 1, 0.5, 0.2, 0.05.
  rows[0] = MakeRow(0, {"healthy", "quiet", "", "", "", "0", "1", "", "10:10 20:6", ""});
  rows[1] = MakeRow(1, {"healthy", "whirl", "", "", "", "0", "1", "", "30:3 40:1", ""});
  // Faults at the end of a quarter period: the first decision comes 30 us after them.
  const std::string at = "0.06001";
  rows[2] = MakeRow(2, {"faulty", "quiet", "A:1", "open", at, "0", "1", "",
                        "coil 0:15 2:35 bearing 0:15:1 2:35:1", ""});
  rows[3] = MakeRow(3, {"faulty", "quiet", "A:2", "open", at, "0", "1", "",
                        "coil 0:15 9:25 bearing 0:33:0 9:35:0", ""});
  rows[4] = MakeRow(4, {"faulty", "quiet", "A:3", "open", at, "0", "1", "",
                        "coil 0:15 4:50 bearing 0:15:1 4:50:1", ""});
  rows[5] = MakeRow(5, {"faulty", "quiet", "A:4", "open", at, "0", "1", "", "", "error: lost"});
  const auto curves = CurvesOf(study, rows);
  ASSERT_EQ(curves.size(), 1u);
  const DetectorCurves& d = curves[0];
  EXPECT_EQ(d.all.windows, 20);
  EXPECT_EQ(d.all.share[10], 1);
  EXPECT_EQ(d.all.share[11], 0.5);
  EXPECT_EQ(d.all.share[30], 0.2);
  EXPECT_EQ(d.all.share[31], 0.05);
  EXPECT_EQ(d.all.share[41], 0);
  ASSERT_EQ(d.scenarios.size(), 2u);
  EXPECT_EQ(d.scenarios[0].share[20], 6 / 16.0);
  EXPECT_EQ(d.scenarios[1].share[31], 0.25);
  EXPECT_EQ(d.budget_level, 21);
  ASSERT_EQ(d.faults.size(), 1u);
  const FaultCurve& c = d.faults[0];
  EXPECT_EQ(c.runs, 3);
  EXPECT_EQ(c.detected[21], 1);
  EXPECT_EQ(c.detected[26], 2 / 3.0);
  EXPECT_EQ(c.detected[36], 1 / 3.0);
  EXPECT_EQ(c.detected[51], 0);
  EXPECT_NEAR(c.median[15], 30e-6, 1e-12);
  EXPECT_NEAR(c.median[21], 30e-6 + 4 * 40e-6, 1e-12);  // 2, 4, 9 periods
  EXPECT_NEAR(c.late[21], 30e-6 + 9 * 40e-6, 1e-12);
  EXPECT_TRUE(std::isinf(c.late[26]));
  EXPECT_TRUE(std::isinf(c.median[36]));
  EXPECT_EQ(c.named[15], 2 / 3.0);  // the second bearing's first alarm is another coil's
  EXPECT_EQ(c.named[34], 2 / 3.0);
  EXPECT_EQ(c.named[40], 1 / 3.0);
  // Steps of `detected` over log10 of the share from 1/20 to 1 by the lowest threshold with at most
  // that share: 1 (level 11 on) from 0.5, 1 (level 21) from 0.2, 2/3 (level 31) from 0.05.
  const double all = std::log10(20.0);
  EXPECT_NEAR(c.area, (std::log10(0.2 / 0.05) * 2 / 3 + std::log10(1 / 0.2)) / all, 0.01);
  rows[6] = MakeRow(6, {"faulty", "quiet", "A:1", "open", at, "0", "1", "", "0:15", ""});
  EXPECT_THROW(CurvesOf(study, rows), InputError);
}

/// Looks at the clock, not at the bearing.
class Blind : public CoilDetector {
 public:
  Lane Period(const MeasuredPeriod& in) override {
    Lane out;
    for (int j = 0; j < kLanes; ++j)
      out[j] =
          Uniform(99, static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(in.t * 25e3 + 0.5));
    return out;
  }
};
std::unique_ptr<CoilDetector> MakeBlind(const CoilDetectorSetup&) {
  return std::make_unique<Blind>();
}

TEST(DetectorStudy, ABlindDetectorIsRankedLastAndByChanceAlone) {
  DetectorStudy study = ReadDetectorStudy(kSmall);
  study.detectors.insert(study.detectors.begin() + 2,
                         {"blind", "-", "a clock", kRequired, kRequired, MakeBlind});
  const DetectorStudyPlan plan(study);
  Rows rows;
  for (std::size_t run = 0; run < study.runs(); ++run) rows[run] = plan.Simulate(run, nullptr);
  for (const auto& [run, row] : rows) EXPECT_EQ(row.Cells().back(), "") << run;
  const auto curves = CurvesOf(study, rows);
  const auto order = Ranking(curves);
  EXPECT_EQ(curves[order.back()].name, "blind");
  const DetectorCurves& blind = curves[2];
  EXPECT_EQ(blind.faults.size(), 3u);
  EXPECT_LT(blind.score, 0.2);
  for (const FaultCurve& c : blind.faults) EXPECT_LT(c.area, 0.4) << c.kind;  // 8 faults: coarse
  const auto named = [&](const char* name) {
    return *std::find_if(curves.begin(), curves.end(),
                         [&](const DetectorCurves& d) { return d.name == name; });
  };
  // The coupled detector misses nothing, at its own threshold without a false alarm.
  const DetectorCurves coupled = named("coupled");
  const auto nine = static_cast<std::size_t>(LevelAtLeast(9));
  EXPECT_EQ(coupled.all.share[nine], 0);
  for (const FaultCurve& c : coupled.faults) {
    EXPECT_EQ(c.detected[nine], 1) << c.kind;
    EXPECT_LE(c.median[nine], 80e-6) << c.kind;
  }
  // At equal false alarms limits that follow the gap can be less than 0.6 of the fixed ones.
  const DetectorCurves fixed = named("paper-every-period"), online = named("paper-online"),
                       known = named("paper-coupled");
  EXPECT_LT(ValueOf(online.budget_level), 0.6 * ValueOf(fixed.budget_level));
  const auto shorts_found = [](const DetectorCurves& d) {
    const auto it = std::find_if(d.faults.begin(), d.faults.end(),
                                 [](const FaultCurve& c) { return c.kind.starts_with("partial"); });
    return it->detected[static_cast<std::size_t>(d.budget_level)];
  };
  EXPECT_EQ(shorts_found(online), 1);
  EXPECT_EQ(shorts_found(known), 1);
}

TEST(DetectorStudy, SameBytesForAnyJobsAndAfterAKill) {
  const CampaignFolder f;
  const std::string command = "detectors " + kSmall + " --no-report -o ";
  const Outcome one = f.Ambrig(command + "one --jobs 1");
  ASSERT_EQ(one.exit, 0) << one.text;
  EXPECT_NE(one.text.find("32 of 32 runs"), std::string::npos) << one.text;
  const Outcome killed = f.In(std::string(AMBRIG_BINARY) + " " + command +
                              "cut --jobs 3 & p=$!; for k in $(seq 1500); do [ $(cat "
                              "cut/journal.txt 2>/dev/null | wc -l) -lt 4 ] || break; "
                              "sleep 0.02; done; kill -9 $p; wait $p; true");
  ASSERT_EQ(killed.exit, 0) << killed.text;
  const std::string kept = f.Read("cut/journal.txt");
  ASSERT_GE(std::count(kept.begin(), kept.end(), '\n'), 4);
  ASSERT_FALSE(std::filesystem::exists(f.File("cut/table.csv")));
  const Outcome resumed = f.Ambrig(command + "cut --jobs 3 --json cut.json --html cut.html");
  ASSERT_EQ(resumed.exit, 0) << resumed.text;
  EXPECT_NE(resumed.text.find("resumed, "), std::string::npos);
  EXPECT_TRUE(f.Read("cut/journal.txt").starts_with(kept.substr(0, kept.rfind('\n'))));
  for (const char* name : {"table.csv", "curves.json", "curves.txt"})
    EXPECT_EQ(f.Read(std::string("one/") + name), f.Read(std::string("cut/") + name)) << name;
  const auto json = nlohmann::json::parse(f.Read("cut.json"));
  EXPECT_EQ(json["detectors"].size(), CoilDetectorKinds().size());
  EXPECT_EQ(json["windows"], 1536);
  const std::string html = f.Read("cut.html");
  for (const char* part : {"ROC curves", "Delay against false alarms", "paper-online"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

TEST(DetectorStudy, WrongStudiesAreSaidInOneLine) {
  const CampaignFolder f;
  f.Write("h.toml", "rig = \"rig.toml\"\nduration = 0.05\n");
  f.Write("f.toml",
          "rig = \"rig.toml\"\nduration = 0.05\n[faults]\nsets = \"single\"\ntime = 0.03\n");
  f.Write("two.toml",
          "rig = \"rig.toml\"\nduration = 0.05\n[faults]\nsets = [[1, 2]]\ntime = 0.03\n");
  f.Write("late.toml",
          "rig = \"rig.toml\"\nduration = 0.05\n[faults]\nsets = \"single\"\ntime = 0.045\n");
  const std::string good = "healthy = \"h.toml\"\nfaulty = \"f.toml\"\n";
  const std::pair<std::string, const char*> wrong[] = {
      {"healthy = \"h.toml\"\n", "faulty"},
      {"healthy = \"f.toml\"\nfaulty = \"f.toml\"\n", "has faults"},
      {"healthy = \"h.toml\"\nfaulty = \"two.toml\"\n", "sets of one coil"},
      {"healthy = \"h.toml\"\nfaulty = \"late.toml\"\n", "window after the fault"},
      {good + "window = 0.04\n", "at least begin + settle + window"},
      {good + "window = -1\n", "window = -1"},
      {good + "budget = 2\n", "budget = 2"},
      {good + "detectors = [\"glrt\", \"glrt\"]\n", "each once of"},
      {good + "detectors = [\"glr\"]\n", "current-error"},
      {good + "detectors = []\n", "some of"},
      {good + "detector = [\"glrt\"]\n", "detector"},
      {"healthy = \"none.toml\"\nfaulty = \"f.toml\"\n", "none.toml"},
  };
  for (const auto& [text, words] : wrong) {
    f.Write("s.toml", text);
    const Outcome o = f.Ambrig("detectors s.toml -o out");
    EXPECT_EQ(o.exit, 2) << text << o.text;
    EXPECT_EQ(std::count(o.text.begin(), o.text.end(), '\n'), 1) << text << o.text;
    EXPECT_NE(o.text.find(words), std::string::npos) << text << o.text;
  }
  EXPECT_FALSE(std::filesystem::exists(f.File("out")));
}

TEST(DetectorStudy, FullStudyOfTheRepositoryCanBeRead) {
  const DetectorStudy s =
      ReadDetectorStudy(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/studies/detectors.toml");
  EXPECT_GT(s.runs(), 2000u);
  EXPECT_EQ(s.detectors.size(), CoilDetectorKinds().size());
}

}  // namespace
}  // namespace ambrig::testing
