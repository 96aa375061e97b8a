// The records of two independent simulators that follow base_model.md (tests/data/base-records,
// copied from the contract's data): readings within 20 nm, currents within 2 mA, load cell within
// 0.5 N, and 2 um after the first contact of lift-off.
#include <gtest/gtest.h>

#include <cmath>

#include "core/record/hdf5.h"
#include "rig/rig_file.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {
namespace {

class BaseRecords : public ::testing::TestWithParam<const char*> {};

double Allowed(const std::string& channel, const std::string& name) {
  const auto dot = channel.find('.');
  const char kind = channel[dot == std::string::npos ? 0 : dot + 1];
  // the simulators' own 11 mA
  if (kind == 'i' || kind == 's') return name == "lift-off" ? 11e-3 : 2e-3;
  if (kind == 'f') return 0.5;
  if (kind == 'd') return 1e-4;
  if (channel == "bus") return 1e-9;
  if (channel == "omega" || channel == "theta") return 1e-3;  // single precision in the files
  return name == "lift-off" ? 2e-6 : 20e-9;
}

TEST_P(BaseRecords, AreMetByTheSwitchingEngine) {
  const std::string name = GetParam(),
                    folder = std::string(AMBRIG_SOURCE_DIR) + "/tests/data/base-records/";
  const RigParameters rig = ReadRig(folder + "rig.toml");
  const Scenario scenario = ReadScenario(folder + name + ".toml", rig);
  const Record ours = SwitchingEngine(rig, scenario, {}).Run().record;
  const Record theirs = ReadHdf5(folder + name + ".h5");
  ASSERT_EQ(ours.rows(), theirs.rows());
  ASSERT_GT(theirs.channels.size(), 10u);
  for (const Channel& c : theirs.channels) {
    const Channel* mine = ours.Find(c.name);
    ASSERT_NE(mine, nullptr) << c.name;
    double worst = 0;
    for (std::size_t k = 0; k < c.samples.size(); ++k)
      worst = std::max(worst, std::abs(mine->samples[k] - c.samples[k]));
    EXPECT_LE(worst, Allowed(c.name, name)) << name << " " << c.name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, BaseRecords,
                         ::testing::Values("steps", "multisine-60hz", "run-up", "lift-off",
                                           "clamped-ramps", "coil-burst"),
                         [](const auto& record) {
                           std::string name = record.param;
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

// The general path (iron laws, shorts, moving bus) takes the same steps as the fast one.
TEST(SwitchingEngine, GeneralPathGivesTheFastPathsRecord) {
  const std::string folder = std::string(AMBRIG_SOURCE_DIR) + "/tests/data/base-records/";
  const RigParameters rig = ReadRig(folder + "rig.toml");
  const Scenario scenario = ReadScenario(folder + "coil-burst.toml", rig);
  EngineOptions general;
  general.force_general_path = true;
  const Record a = SwitchingEngine(rig, scenario, {}).Run().record,
               b = SwitchingEngine(rig, scenario, general).Run().record;
  for (std::size_t c = 0; c < a.channels.size(); ++c)
    for (std::size_t k = 0; k < a.rows(); ++k)
      ASSERT_NEAR(a.channels[c].samples[k], b.channels[c].samples[k], 1e-8)
          << a.channels[c].name << " row " << k;
}

// files.md: load cells give the mean force over the period before t, in a burst as in rows of
// whole periods.
TEST(SwitchingEngine, LoadCellOfABurstHoldsThePeriodBefore) {
  const std::string folder = std::string(AMBRIG_SOURCE_DIR) + "/tests/data/base-records/";
  const RigParameters rig = ReadRig(folder + "rig.toml");
  Scenario scenario = ReadScenario(folder + "clamped-ramps.toml", rig);
  scenario.noise = false;
  scenario.duration = 0.06;
  const double pwm = rig.amplifier.switching_frequency;
  const int samples = rig.samples_per_period();
  scenario.record_rate = pwm;
  const Record rows = SwitchingEngine(rig, scenario, {}).Run().record;
  scenario.record_rate = pwm * samples;
  const Record burst = SwitchingEngine(rig, scenario, {}).Run().record;
  const Channel *slow = rows.Find("A.fx"), *fast = burst.Find("A.fx");
  ASSERT_TRUE(slow && fast);
  double moved = 0;
  for (std::size_t n = 1; n + 1 < slow->samples.size(); ++n) {
    moved = std::max(moved, std::abs(slow->samples[n + 1] - slow->samples[n]));
    for (int k = 0; k < samples; ++k)
      ASSERT_EQ(fast->samples[n * static_cast<std::size_t>(samples) + static_cast<std::size_t>(k)],
                slow->samples[n])
          << n << " " << k;
  }
  EXPECT_GT(moved, 0.01);  // or nothing was tested
}

TEST(SwitchingEngine, SameSeedSameBits) {
  const std::string folder = std::string(AMBRIG_SOURCE_DIR) + "/tests/data/base-records/";
  const RigParameters rig = ReadRig(folder + "rig.toml");
  Scenario scenario = ReadScenario(folder + "coil-burst.toml", rig);
  scenario.noise = true;
  const Record a = SwitchingEngine(rig, scenario, {}).Run().record,
               b = SwitchingEngine(rig, scenario, {}).Run().record;
  scenario.seed += 1;
  const Record other = SwitchingEngine(rig, scenario, {}).Run().record;
  EXPECT_EQ(a.Find("A.i1")->samples, b.Find("A.i1")->samples);
  EXPECT_NE(a.Find("A.i1")->samples, other.Find("A.i1")->samples);
}

}  // namespace
}  // namespace ambrig
