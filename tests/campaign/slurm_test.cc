// --engine slurm against a real, private Slurm with two nodes: the disk is full, then a task, the
// controller and a node are killed. Skipped where Slurm is not installed (tools/setup.sh --tests).
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "campaign/slurm_queue.h"
#include "tests/campaign/campaign_folder.h"

namespace ambrig::testing {
namespace {

/// 8 sets x 2 speeds x 30 seeds = 480 runs, long enough that a task is met while it runs.
constexpr const char* kClusterCampaign = R"(name = "cluster"
rig = "rig.toml"
duration = 0.1
seeds = 30
[faults]
bearings = ["A"]
sets = "single"
time = 0.002
[operation]
speeds = [0.0, 157.0]
)";

TEST(SlurmQueue, ArraysAreNamedByRanges) {
  EXPECT_EQ(ArrayText({1, 2, 3, 4, 7}), "1-4,7");
  EXPECT_EQ(ArrayText({3}), "3");
  EXPECT_EQ(ArrayText({1, 3, 4, 6}), "1,3-4,6");
}

class PrivateSlurm : public ::testing::Test {
 protected:
  void SetUp() override {
    if (Shell("command -v slurmctld slurmd munged sbatch").exit != 0)
      GTEST_SKIP() << "Slurm is not installed: tools/setup.sh --tests";
    if (Shell("grep -q ' /sys/fs/cgroup' /proc/self/mounts").exit != 0)
      GTEST_SKIP() << "no control groups here, as in a bare chroot: slurmd wants them";
    // Ports of this process: another clone's tests may run their own cluster.
    setenv("SLURM_TEST_PORT", std::to_string(17000 + 4 * (::getpid() % 3000)).c_str(), 1);
    const Outcome up = Shell(Tool("start") + " 2 1");
    ASSERT_EQ(up.exit, 0) << up.text;
    started_ = true;
    folder_.Write("c.toml", kClusterCampaign);
  }
  void TearDown() override {
    if (started_) Shell(Tool("stop"));
  }
  std::string Tool(const std::string& action) const {
    return std::string(AMBRIG_SOURCE_DIR) + "/tools/private_slurm.sh " + action + " " +
           folder_.File("slurm");
  }
  std::string Environment() const {
    return "export SLURM_CONF=" + folder_.File("slurm/slurm.conf") + "; ";
  }

  CampaignFolder folder_;
  bool started_ = false;
};

TEST_F(PrivateSlurm, FullDiskAndKilledTaskControllerAndNodeLoseNothing) {
  const std::string source = AMBRIG_SOURCE_DIR;
  const Outcome harm = folder_.In("bash " + source + "/tests/campaign/slurm_harm.sh " +
                                  AMBRIG_BINARY + " " + source + "/tools/private_slurm.sh");
  EXPECT_EQ(harm.exit, 0) << harm.text << folder_.Read("full.txt") << folder_.Read("said.txt");
  EXPECT_NE(harm.text.find("disk full at"), std::string::npos)
      << harm.text << folder_.Read("full.txt");
  EXPECT_NE(harm.text.find("disk full for a task"), std::string::npos) << harm.text;
  EXPECT_NE(harm.text.find("task killed"), std::string::npos) << harm.text;
  EXPECT_NE(harm.text.find("controller killed"), std::string::npos) << harm.text;
  EXPECT_NE(harm.text.find("node killed"), std::string::npos) << harm.text;
  ASSERT_EQ(folder_.Ambrig("campaign c.toml -o local --no-report").exit, 0);
  EXPECT_TRUE(folder_.Read("out/table.csv") == folder_.Read("local/table.csv"));
  EXPECT_FALSE(folder_.Read("local/table.csv").empty());
}

TEST_F(PrivateSlurm, RefusedOptionsAreSaidInOneLine) {
  const Outcome o =
      folder_.In(Environment() + AMBRIG_BINARY +
                 " campaign c.toml -o out --engine slurm --tasks 2 --sbatch=--partition=nowhere");
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_NE(o.text.find("--engine slurm: sbatch: "), std::string::npos) << o.text;
  EXPECT_NE(o.text.find("nvalid partition"), std::string::npos) << o.text;
}

}  // namespace
}  // namespace ambrig::testing
