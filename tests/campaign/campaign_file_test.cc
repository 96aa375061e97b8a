// What a campaign file means, and what is said of a wrong one.
#include "campaign/campaign_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "campaign/row.h"
#include "campaign/run_plan.h"
#include "rig/true_rig.h"
#include "tests/campaign/campaign_folder.h"

namespace ambrig::testing {
namespace {

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string Complaint(const CampaignFolder& f, const std::string& from, const std::string& to) {
  f.Write("c.toml", Replaced(kSmallCampaign, from, to));
  return ErrorText<InputError>([&] { ReadCampaign(f.File("c.toml")); });
}

struct Mistake {
  const char *from, *to, *said;
};

TEST(CampaignFile, EveryMistakeIsOneLineWithItsPlace) {
  const Mistake mistakes[] = {
      {"duration = 0.01", "durations = 0.01", "durations: unknown key, did you mean duration?"},
      {"duration = 0.01", "duration = 0.01\ncolour = 1", "c.toml:4: colour: unknown key"},
      {"duration = 0.01", "duration = -1", "c.toml:3: duration = -1"},
      {"rig = \"rig.toml\"", "rig = \"no.toml\"", "no.toml"},
      {"rig = \"rig.toml\"", "", "rig: is missing"},
      {"\"single\"", "\"singles\"", "did you mean single?"},
      {"\"single\"", "[[1, 9]]", "c.toml:6: faults.sets = [..9..] in set 1"},
      {"\"single\"", "[[1, 2], [2, 1]]", "set 2 is given twice"},
      {"\"single\"", "[]", "faults.sets = []"},
      {"[\"A\"]", "[\"C\"]", "c.toml:5: faults.bearings = \"C\", allowed: each once of A, B, Z"},
      {"kind = \"open\"", "kind = \"opened\"", "did you mean open?"},
      {"fraction = 0.5", "fraction = 1.5", "fraction = 1.5, allowed: above 0 to below 1"},
      {"fraction = 0.5", "gain = 1", "unknown key, allowed with kind partial-short"},
      {"time = 0.002", "time = 0.02", "allowed: below the duration of 0.01 s"},
      {"time = 0.002", "time = nan", "faults.time = nan"},
      {"speeds = [0.0, 157.0]", "speeds = [1.0, 1.0]", "is given twice"},
      {"speeds = [0.0, 157.0]", "speeds = [1e9]", "operation.speeds = 1000000000"},
      {"speeds = [0.0, 157.0]", "loads = [3.0]", "operation.loads = 3"},
      {"speeds = [0.0, 157.0]", "positions = [1.0]", "operation.positions = 1"},
      {"draws = 1", "draws = 0", "spread.draws = 0"},
      {"draws = 1", "draws = 1\nmethod = \"random\"", "allowed: latin-hypercube, sobol"},
      {"draws = 1", "draws = 1000000\n", "allowed: up to 10000000"},
      {"duration = 0.01", "duration = 0.01\nseeds = 0", "seeds = 0"},
      {"duration = 0.01", "duration = 0.01\nseeds = [1.5]", "seeds = 1.5"},
      {"duration = 0.01", "scenarios = [\"none.toml\"]", "none.toml"},
  };
  for (const Mistake& m : mistakes) {
    const CampaignFolder f;
    const std::string said = Complaint(f, m.from, m.to);
    EXPECT_NE(said.find(m.said), std::string::npos) << m.to << "\n" << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST(CampaignFile, SetsAndOnsetsSpanTheirProduct) {
  const CampaignFolder f;
  f.Write("c.toml",
          Replaced(Replaced(kSmallCampaign, "\"single\"", "\"all\""), "time = 0.002",
                   "time = 0.002\nonset = [\"sequential\", \"simultaneous\"]\nspacing = 0.0005"));
  const Campaign c = ReadCampaign(f.File("c.toml"));
  EXPECT_EQ(c.sets.size(), 255u);
  EXPECT_EQ(c.cases.size(), 2u * (255 + 247));  // one coil has one onset
  EXPECT_EQ(c.runs(), 2u * 2 * (255 + 247));
}

TEST(RunPlan, FaultsComeAtTheirTimes) {
  const CampaignFolder f;
  f.Write("c.toml",
          Replaced(Replaced(kSmallCampaign, "\"single\"", "[[2, 5]]"), "time = 0.002",
                   "time = 0.002\nonset = \"sequential\"\nspacing = 0.003\nphases = [0.0, 0.5]"));
  const RunPlan plan(ReadCampaign(f.File("c.toml")));
  ASSERT_EQ(plan.campaign().runs(), 8u);
  const PlannedRun p = plan.Make(2);  // second phase, first speed
  ASSERT_EQ(p.scenario.faults.size(), 2u);
  EXPECT_EQ(p.scenario.faults[1].target, "A.coil5");
  EXPECT_DOUBLE_EQ(p.scenario.faults[0].time, 0.002 + 0.5 * 8e-5);
  EXPECT_DOUBLE_EQ(p.scenario.faults[1].time, 0.005 + 0.5 * 8e-5);
  EXPECT_EQ(p.speed, 0);
  EXPECT_EQ(plan.Make(3).speed, 157.0);
  EXPECT_NE(plan.Make(3).scenario.seed, p.scenario.seed);
}

// The plant gets the draw, the controller keeps what the drawing says.
TEST(RunPlan, DrawsMoveThePlantWithinItsToleranceAndNotTheController) {
  const CampaignFolder f;
  f.Write("c.toml", Replaced(kSmallCampaign, "draws = 1", "draws = 64"));
  const RunPlan plan(ReadCampaign(f.File("c.toml")));
  double sum = 0, squares = 0;
  for (std::size_t draw = 0; draw < 64; ++draw) {
    const PlannedRun p = plan.Make(draw);
    EXPECT_EQ(p.rig.rotor.mass, 4.2);
    const double z = (TrueRig(p.rig)->rotor.mass - 4.2) / 0.01;
    sum += z / 64;
    squares += z * z / 64;
  }
  EXPECT_NEAR(sum, 0, 0.02);  // Latin hypercube: far better than 1/sqrt(64)
  EXPECT_NEAR(squares, 1, 0.05);
}

TEST(RunPlan, LoadIsAShareOfTheCapacityThatIncludesTheWeight) {
  const CampaignFolder f;
  f.Write("c.toml",
          Replaced(kSmallCampaign, "speeds = [0.0, 157.0]", "speeds = [0.0]\nloads = [0.0, 0.8]"));
  const RunPlan plan(ReadCampaign(f.File("c.toml")));
  EXPECT_TRUE(plan.Make(0).scenario.loads.empty());
  const PlannedRun p = plan.Make(1);
  double down = 0;
  for (const LoadSpec& l : p.scenario.loads) down -= l.fy;
  const double weight = 4.2 * 9.81 * 0.130 / 0.250;  // of bearing A at z = -0.12, B at 0.13
  EXPECT_NEAR(down + weight, 0.8 * p.theory.capacity, 1e-9);
  EXPECT_EQ(p.theory.cls, "exact");
}

// The shaft is where the file says when the fault comes, and did not run past it on the way.
TEST(RunPlan, PositionIsReachedWithoutOvershoot) {
  const CampaignFolder f;
  f.Write("c.toml",
          "rig = \"rig.toml\"\nduration = 0.07\n[faults]\ntime = 0.06\nbearings = "
          "[\"A\"]\n[operation]\npositions = [0.6]\n");
  const RunPlan plan(ReadCampaign(f.File("c.toml")));
  const Row row = SimulateRow(plan, 0, nullptr);
  EXPECT_EQ(row.At("verdict"), "up");
  EXPECT_NEAR(row.Number("bearing_orbit"), 0.6 * 2e-4, 0.1 * 0.6 * 2e-4);
  EXPECT_NEAR(row.Number("late_orbit"), 0.6 * 2e-4, 0.1 * 0.6 * 2e-4);
}

// A row may not state a position that its run was never told.
TEST(CampaignFile, PositionsNeedABearingThatHoldsThem) {
  const CampaignFolder f;
  const auto said = [&](const std::string& text) {
    f.Write("c.toml", "rig = \"rig.toml\"\nduration = 0.07\n" + text);
    return ErrorText<InputError>([&] { ReadCampaign(f.File("c.toml")); });
  };
  const std::string faults = "[faults]\nsets = \"single\"\ntime = 0.06\nbearings = ";
  const std::string away = "[operation]\npositions = [0.0, 0.5]\n";
  EXPECT_NE(said(faults + "[\"Z\"]\n" + away)
                .find("c.toml:8: operation.positions: other than 0 at bearing Z of"),
            std::string::npos);
  EXPECT_NE(said(faults + "[\"A\", \"Z\"]\n" + away).find("bearing Z"), std::string::npos);
  EXPECT_EQ(said(faults + "[\"A\", \"B\"]\n" + away), "");
  EXPECT_EQ(said(faults + "[\"Z\"]\n[operation]\npositions = [0.0]\n"), "");
  // Without [faults] the rig's first bearing is the one that is moved: of a network of poles, none.
  f.Write("rig.toml", ReadBytes(AMBRIG_SOURCE_DIR "/examples/stators/six_poles.toml"));
  EXPECT_NE(said(away).find("operation.positions: other than 0 at bearing A"), std::string::npos);
}

}  // namespace
}  // namespace ambrig::testing
