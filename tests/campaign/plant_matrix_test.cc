// The matrix effect x fault against rows made by hand.
#include "campaign/plant_matrix.h"

#include <gtest/gtest.h>

#include "campaign/plants.h"
#include "tests/campaign/table_rows.h"

namespace ambrig::testing {
namespace {

struct Seen {
  std::string effect, plant, spread, learnt, kind, detected, delay, actions, verdict, without;
  std::string orbit = "2e-06", orbit_without = "1e-06";
  std::string judged = "1";  // of the faults
  std::string set = "A:3";
  std::string doubtful = "no", doubtful_share = "0";
};

Rows RowsOf(const std::vector<Seen>& list) {
  Rows rows;
  for (const Seen& s : list) {
    const std::size_t run = rows.size();
    const bool faulty = !s.kind.empty();
    rows[run] = RowOf(run, {{"failed", faulty ? "1" : "0"},
                            {"judged", faulty ? s.judged : "0"},
                            {"set", faulty ? s.set : "A:healthy"},
                            {"kind", s.kind},
                            {"effect", s.effect},
                            {"plant", s.plant},
                            {"spread", s.spread},
                            {"commissioned", s.learnt},
                            {"verdict", s.verdict},
                            {"detected", s.detected},
                            {"detection_delay", s.delay},
                            {"false_alarms", s.actions},
                            {"false_actions", s.actions},
                            {"coil_periods", "1000"},
                            {"doubtful", s.doubtful},
                            {"doubtful_share", s.doubtful_share},
                            {"peak_orbit", s.orbit},
                            {"orbit_without", s.orbit_without},
                            {"verdict_without", s.without}});
  }
  return rows;
}

const std::string kEddy = "eddy-currents";

// A fault that comes after the rotor was lost is neither found nor missed; the contact counts.
TEST(PlantMatrix, FaultsOfALostRotorAreNoFindings) {
  Seen lost = {kEddy, kEddy + " low", "1", "yes", "open", "0", "", "0", "drop", "drop"};
  lost.judged = "0";
  const std::string text = PlantMatrix(
      RowsOf({{kEddy, kEddy + " low", "2", "yes", "open", "1", "2e-4", "0", "up", "drop"}, lost}));
  EXPECT_NE(text.find("| 1/1; 0.20, 0.20 ms | 1, 2 |"), std::string::npos) << text;
}

TEST(PlantMatrix, SaysAtWhichSizeDetectionBreaks) {
  const std::string text = PlantMatrix(RowsOf({
      {kEddy, kEddy + " low", "1", "yes", "open", "1", "1e-4", "0", "up", "up"},
      {kEddy, kEddy + " low", "2", "yes", "open", "1", "2e-4", "0", "up", "drop"},
      {kEddy, kEddy + " typical", "1", "yes", "open", "1", "3e-4", "0", "up", "drop"},
      {kEddy, kEddy + " high", "1", "yes", "open", "0", "", "0", "drop", "drop"},
      {kEddy, kEddy + " typical", "1", "yes", "amplifier-off", "1", "1e-4", "1", "up", "up"},
      {kEddy, kEddy + " low", "1", "yes", "", "", "", "0", "up", "up"},
  }));
  // Missed at the strong end only; in contact once with fault tolerance, three times without.
  EXPECT_NE(text.find("| eddy-currents | 1 | 1/1; 0.10, 0.10 ms; wrong coil 1; breaks at typical "
                      "(cutoff 3000 Hz) | 3/4; 0.20, 0.30 ms; breaks at high (cutoff 300 Hz) | "
                      "1, 3 |"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("**Commissioned plants, faults**"), std::string::npos);
  EXPECT_EQ(text.find("not commissioned"), std::string::npos);
}

TEST(PlantMatrix, HealthyPlantsCountOnceWithTheBoundOfTheirShare) {
  std::vector<Seen> rows;
  for (const char* spread : {"1", "2"})
    for (int operation = 0; operation < 3; ++operation) {
      rows.push_back(
          {"none", "none", spread, "no", "", "", "", operation == 2 ? "1" : "0", "up", "up"});
      rows.back().orbit = operation == 1 ? "9e-06" : "3e-06";
      rows.back().orbit_without = operation == 1 ? "9e-06" : "2e-06";
      rows.back().doubtful = operation == 0 ? "yes" : "no";
      rows.back().doubtful_share = operation == 0 ? "0.3" : "0";
    }
  rows.push_back({"mixture", "a+b+c", "1", "no", "", "", "", "0", "drop", "up"});
  const std::string text = PlantMatrix(RowsOf(rows));
  // Both plants were acted on: their share may be 1. The worst ratio of orbits is 3/2. Both
  // doubted their model, in 30 % of one of three runs of equal length.
  EXPECT_NE(text.find("| no effect | 2/2, < 100 % | 2/2, < 100 % | 2/2, < 100 % | 2, 10 % | "
                      "3, 2 um |"),
            std::string::npos)
      << text;
  // One plant, not acted on: 1 - 0.05.
  EXPECT_NE(text.find("| mixtures of effects | 0/1, < 95 % | 0/1, < 95 % | 1/1, < 100 % | 0, 0 % | "
                      "- |"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("| **all** | 2/3, "), std::string::npos) << text;
  EXPECT_TRUE(PlantMatrix({}).empty());
}

// Seven opens in 0.1 to 0.4 ms and one that is missed: 3 of 8 within 0.25 ms, 7 of 8 in time at
// all. Shares are rounded down.
TEST(PlantMatrix, SharesWithinTheWantedTimes) {
  std::vector<Seen> rows;
  for (const char* delay : {"1e-4", "2e-4", "2.5e-4", "2.6e-4", "3e-4", "4e-4", "4e-4", ""})
    rows.push_back(
        {"none", "none", "1", "yes", "open", *delay ? "1" : "0", delay, "0", "up", "up"});
  rows.front().actions = "1";
  const std::string text = PlantMatrix(RowsOf(rows));
  EXPECT_NE(text.find("| fault | coils | found | median, 95 % | within 0.25 ms | within 0.5 ms | "
                      "within 3 ms | wrong coil |"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("| open | A:3 | 7/8 | 0.26, 0.40 ms | 37.5 % | 87.5 % | 87.5 % | 1 |"),
            std::string::npos)
      << text;
}

// Of two coils that fail together both must be found: where one is missed the other's delay is no
// finding, and a table for each set says which pair it was.
TEST(PlantMatrix, OfTwoCoilsBothMustBeFound) {
  std::vector<Seen> rows{{"none", "none", "1", "yes", "open", "2", "1e-4", "0", "up", "up"},
                         {"none", "none", "1", "yes", "open", "1", "2e-3", "0", "up", "up"},
                         {"none", "none", "1", "yes", "open", "2", "3e-4", "0", "up", "up"}};
  for (Seen& s : rows) s.judged = "2";
  rows[0].set = rows[1].set = "A:3+4";
  rows[2].set = "A:3+7";
  const std::string text = PlantMatrix(RowsOf(rows));
  EXPECT_NE(text.find("| no effect | 0 | 2/3; 0.30, 0.30 ms | 0, 0 |"), std::string::npos) << text;
  EXPECT_NE(text.find("| open | all | 2/3 | 0.30, 0.30 ms | 33.3 % | 66.6 % | 66.6 % | 0 |\n"
                      "| open | A:3+4 | 1/2 | 0.10, 0.10 ms | 50 % | 50 % | 50 % | 0 |\n"
                      "| open | A:3+7 | 1/1 | 0.30, 0.30 ms | 0 % | 100 % | 100 % | 0 |"),
            std::string::npos)
      << text;
}

TEST(PlantMatrix, SizesOfEffectsInTheirUnits) {
  EXPECT_EQ(EffectSizeText("eddy-currents", "low"), "cutoff 30000 Hz");
  EXPECT_EQ(EffectSizeText("eddy-currents", "high"), "cutoff 300 Hz");
  EXPECT_EQ(EffectSizeText("unbalance", "high"), "c 0.0001 kg m, s 0.0001 kg m");
  EXPECT_TRUE(EffectSizeText("sensor-runout", "high").ends_with(", ..."));
  EXPECT_EQ(EffectSizeText("none", "high"), "");
}

}  // namespace
}  // namespace ambrig::testing
