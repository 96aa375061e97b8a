// Campaigns over plants that have effects of their own.
#include "campaign/plants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "campaign/plant_groups.h"
#include "campaign/plant_table.h"
#include "campaign/row.h"
#include "campaign/run_plan.h"
#include "rig/parameters/rig_parameters.h"
#include "simulation/simulate.h"
#include "tests/campaign/campaign_folder.h"

namespace ambrig::testing {
namespace {

std::string Reality(const std::string& plants, const std::string& kinds = "") {
  return R"(rig = "rig.toml"
duration = 0.03
[faults]
bearings = ["A"]
healthy = true
sets = [[3]]
time = 0.015
[[faults.kind]]
kind = "open"
)" + kinds +
         "[plants]\n" + plants;
}

Campaign Read(const CampaignFolder& f, const std::string& text) {
  f.Write("c.toml", text);
  return ReadCampaign(f.File("c.toml"));
}

TEST(Plants, SizesAreTheEndsAndTheMiddleOfTheUsualRange) {
  const CampaignFolder f;
  const Campaign c = Read(f, Reality("effects = [\"eddy-currents\", \"sensor-offset\"]\n"
                                     "commissioned = \"no\"\n"));
  ASSERT_EQ(c.plants.size(), 7U);
  EXPECT_TRUE(c.plants[0].effects.empty());
  const double cutoff[] = {30000, 3000, 300};
  for (std::size_t k = 0; k < 3; ++k) {
    const CampaignPlant& p = c.plants[1 + k];
    EXPECT_EQ(p.effect, "eddy-currents");
    ASSERT_EQ(p.effects.size(), 2U);  // both radial bearings
    EXPECT_EQ(p.effects[0].target, "A");
    EXPECT_EQ(p.effects[1].target, "B");
    EXPECT_NEAR(p.effects[0].Value("cutoff"), cutoff[k], 1e-6 * cutoff[k]);
  }
  // A healthy set and one with one kind of fault, for every plant.
  EXPECT_EQ(c.runs(), 14U);
}

TEST(Plants, EachHasItsOwnDrawAndMixturesTheirOwnEffects) {
  const CampaignFolder f;
  const std::string text =
      Reality("sizes = []\nmixtures = 20\nmixture_of = [3, 6]\nscale = [1.0, 3.0]\nseed = 4\n");
  const Campaign c = Read(f, text), again = Read(f, text);
  ASSERT_EQ(c.plants.size(), 21U * 2 * 2);
  std::set<std::string> labels;
  for (std::size_t k = 0; k < c.plants.size(); ++k) {
    const CampaignPlant& p = c.plants[k];
    EXPECT_EQ(p.deviates, again.plants[k].deviates);
    EXPECT_EQ(p.commissioned, k % 2 == 1);
    if (k % 2 == 1) {
      EXPECT_EQ(p.deviates, c.plants[k - 1].deviates);  // the same machine
    }
    if (k >= 2) {
      EXPECT_NE(p.deviates, c.plants[k - 2].deviates);
    }
    labels.insert(p.label);
    const auto several = 1 + std::count(p.label.begin(), p.label.end(), '+');
    if (p.effect == "mixture") {
      EXPECT_GE(several, 3) << p.label;
      EXPECT_LE(several, 6) << p.label;
    }
  }
  EXPECT_EQ(labels.size(), 21U);  // machines of the same effects are told apart
}

TEST(Plants, MistakesAreOneLineWithTheirPlace) {
  const CampaignFolder f;
  const std::pair<const char*, const char*> mistakes[] = {
      {"effects = [\"eddy\"]\n", "plants.effects = \"eddy\", allowed: "},
      {"effects = [\"formula\"]\n", "plants.effects = \"formula\", allowed: "},
      {"sizes = [\"huge\"]\n", "plants.sizes = \"huge\", allowed: low, typical, high"},
      {"mixtures = -1\n", "plants.mixtures = -1"},
      {"mixtures = 2\nmixture_of = [4, 2]\n", "plants.mixture_of"},
      {"scale = [20.0]\n", "plants.scale = 20"},
      {"scale = []\n", "plants.scale = []"},
      {"commissioned = \"maybe\"\n", "plants.commissioned = \"maybe\""},
      {"commissioning_duration = 0.0\n", "plants.commissioning_duration = 0"},
      {"commissioning_pulse = 1.5\n", "plants.commissioning_pulse = 1.5"},
      {"warmer = 500.0\n", "plants.warmer = 500 K, allowed -100 to 200 K"},
      {"sensor_drift = -1e-6\n", "plants.sensor_drift = -1e-06 m, allowed 0 to 0.001 m"},
      {"bearings = [\"C\"]\n", "plants.bearings = \"C\", allowed: some of A, B, Z"},
      {"bearings = []\n", "plants.bearings = [], allowed: some of A, B, Z"},
      {"colour = 1\n", "plants.colour: unknown key"},
      {"seed = -1\n", "plants.seed = -1"}};
  for (const auto& [text, said] : mistakes)
    EXPECT_NE(ErrorText<InputError>([&] { Read(f, Reality(text)); }).find(said), std::string::npos)
        << text << ErrorText<InputError>([&] { Read(f, Reality(text)); });
}

/// The value that the plant has: the drawing's where nothing else is known.
double TrueValue(const RigParameters& rig, const std::string& path) {
  for (const Tolerance& t : rig.tolerances)
    if (t.path == path && !std::isnan(t.true_value)) return t.true_value;
  return *ParameterAt(rig, path);
}

// What differs from coil to coil is the machine's: another one in each plant, the same before and
// after it was commissioned.
TEST(Plants, EachIsAnotherUnit) {
  const CampaignFolder f;
  const Campaign c = Read(f, Reality("effects = [\"fringing\"]\nsizes = [\"low\", \"high\"]\n"
                                     "commissioned = \"both\"\nscale = [1.0, 2.0]\n"));
  ASSERT_EQ(c.plants.size(), 12U);
  for (std::size_t k = 0; k < c.plants.size(); ++k) {
    RigParameters rig = c.rig;
    ApplyPlant(c.plants[k], &rig);
    EXPECT_EQ(rig.amplifier.unit, std::floor(static_cast<double>(k) / 2) * 2 + 1) << k;
  }
}

// The resistance of Z has no sd in the file, those of A and B have one.
TEST(Plants, WarmCopperAndMovedZerosAreInTheRunOnly) {
  const CampaignFolder f;
  const std::string machines = Reality(
      "effects = [\"sensor-offset\"]\nsizes = [\"low\"]\ncommissioned = \"no\"\nscale = 2.0\n");
  const Campaign c = Read(f, machines + "warmer = 60.0\nsensor_drift = 1e-5\n"),
                 fresh = Read(f, machines);
  ASSERT_EQ(c.plants.size(), 2U);
  const RunPlan plan(c), before(fresh);
  for (std::size_t run = 0; run < c.runs(); ++run) {
    const PlannedRun then = before.Make(run), now = plan.Make(run);
    RigParameters learnt = c.rig;  // what a commissioning has
    ApplyPlant(*now.plant, &learnt);
    for (const char* bearing : {"A", "B", "Z"}) {
      const std::string path = std::string("bearings.") + bearing + ".resistance";
      const double cold = TrueValue(then.rig, path);
      EXPECT_DOUBLE_EQ(TrueValue(learnt, path), cold);
      EXPECT_DOUBLE_EQ(TrueValue(now.rig, path), cold * (1 + 0.00393 * 60));
      EXPECT_EQ(*ParameterAt(now.rig, path), *ParameterAt(then.rig, path));  // nominal
    }
    EXPECT_NE(TrueValue(then.rig, "bearings.A.resistance"),
              *ParameterAt(c.rig, "bearings.A.resistance"));
    EXPECT_EQ(learnt.effects.size(), then.rig.effects.size());
    ASSERT_EQ(now.rig.effects.size(), then.rig.effects.size() + 5);  // A.x A.y B.x B.y z
    for (std::size_t k = then.rig.effects.size(); k < now.rig.effects.size(); ++k) {
      EXPECT_EQ(now.rig.effects[k].name, "sensor-offset");
      EXPECT_EQ(std::abs(now.rig.effects[k].Value("offset")), 1e-5);
    }
    EXPECT_EQ(now.scenario.seed, then.scenario.seed);
  }
  std::set<double> signs;
  for (const CampaignPlant& p : c.plants)
    for (const EffectInstance& e : p.drift) signs.insert(e.Value("offset"));
  EXPECT_EQ(signs.size(), 2U);  // both, in ten draws
}

// Commissioning the plant of a campaign gives the same file whatever comes afterwards.
TEST(Plants, CommissioningDoesNotSeeWhatComesAfterIt) {
  const CampaignFolder f;
  const std::string machines =
      Reality("sizes = []\ncommissioned = \"yes\"\ncommissioning_duration = 0.15\n");
  const RunPlan cold(Read(f, machines)),
      warm(Read(f, machines + "warmer = 60.0\nsensor_drift = 1e-5\n"));
  const PlannedRun a = cold.Make(0), b = warm.Make(0);
  ASSERT_NE(a.rig.detection.commissioning, "none");
  ASSERT_NE(b.rig.detection.commissioning, "none");
  EXPECT_EQ(ReadBytes(a.rig.detection.commissioning), ReadBytes(b.rig.detection.commissioning));
}

// Effects of a coil's circuit act on the bearings that are named, those of an axis on an axis of
// theirs.
TEST(Plants, EffectsActOnTheBearingsThatAreNamed) {
  const CampaignFolder f;
  const Campaign c = Read(f, Reality("bearings = [\"Z\"]\neffects = [\"eddy-currents\", "
                                     "\"sensor-offset\", \"bus-impedance\"]\n"
                                     "sizes = [\"high\"]\ncommissioned = \"no\"\n"));
  ASSERT_EQ(c.plants.size(), 4U);
  const char* const targets[] = {"Z", "z", "rig"};
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_EQ(c.plants[k + 1].effects.size(), 1U);
    EXPECT_EQ(c.plants[k + 1].effects[0].target, targets[k]);
  }
}

// The small version of scenarios/campaigns/reality.toml: nothing is done to healthy machines,
// whatever they have, and a coil that opens is found, with and without commissioning.
TEST(Plants, HealthyOnesAreLeftAloneAndOpenCoilsAreFound) {
  const CampaignFolder f;
  const Campaign c = Read(
      f,
      Reality("effects = [\"eddy-currents\"]\nsizes = [\"high\"]\ncommissioning_duration = 0.15\n"
              "scale = 2.0\nwithout = true\n"));
  const RunPlan plan(c);
  Rows rows;
  for (std::size_t run = 0; run < c.runs(); ++run) {
    const Row row = rows[run] = SimulateRow(plan, run, nullptr);
    ASSERT_NE(row.At("verdict"), "error") << row.At("note");
    EXPECT_EQ(row.At("verdict"), "up");
    EXPECT_EQ(row.Number("false_actions"), 0) << row.At("plant");
    if (row.Number("failed") > 0) {
      EXPECT_EQ(row.Number("detected"), 1) << row.At("plant");
      EXPECT_LT(row.Number("detection_delay"), 0.5e-3) << row.At("plant");
    } else {
      EXPECT_LT(row.Number("peak_orbit"), 1.1 * row.Number("orbit_without"));
    }
  }
  const std::string text = PlantTables(rows);
  EXPECT_NE(text.find("Not commissioned:"), std::string::npos);
  EXPECT_NE(text.find("| eddy-currents high | 1 | 0 | 0 |"), std::string::npos) << text;
  EXPECT_NE(text.find("| 1/1, "), std::string::npos) << text;
}

// A run to which fault tolerance does nothing is not simulated a second time without it.
TEST(Plants, WhatARunIsWithoutFaultToleranceIsWhatSuchARunIs) {
  const CampaignFolder f;
  const Campaign c = Read(f, Reality("effects = []\ncommissioned = \"no\"\nwithout = true\n"));
  const RunPlan plan(c);
  bool left_alone = false;
  for (std::size_t run = 0; run < c.runs(); ++run) {
    const PlannedRun p = plan.Make(run);
    SimulateOptions options;
    options.record = false;
    left_alone = left_alone || !Simulate(p.rig, p.scenario, options).interfered;
    Scenario plain = p.scenario;
    plain.fault_tolerant = false;
    const RunResult without = Simulate(p.rig, plain, options);
    const double orbit =
        std::max(without.metrics.max_orbit.at("A"), without.metrics.max_orbit.at("B"));
    const Row row = SimulateRow(plan, run, nullptr);
    EXPECT_EQ(row.At("orbit_without"), NumberText(orbit)) << run;
    EXPECT_EQ(row.At("verdict_without"), without.drop        ? "drop"
                                         : without.touchdown ? "touchdown"
                                                             : "up")
        << run;
  }
  EXPECT_TRUE(left_alone);
}

TEST(Plants, TheBoundOfAShareIsClopperAndPearsons) {
  EXPECT_NEAR(UpperBound95(0, 100), 1 - std::pow(0.05, 0.01), 1e-9);
  EXPECT_NEAR(UpperBound95(0, 3000), 3.0 / 3000, 0.01 / 3000 * 3);
  EXPECT_NEAR(UpperBound95(4, 155), 0.058, 5e-4);  // tables of the binomial distribution
  EXPECT_EQ(UpperBound95(0, 0), 1);
  EXPECT_EQ(UpperBound95(7, 7), 1);
}

}  // namespace
}  // namespace ambrig::testing
