// Why a rotor dropped, of runs of one campaign whose events are written by hand.
#include "campaign/drop_reason.h"

#include <gtest/gtest.h>

#include "tests/campaign/campaign_folder.h"

namespace ambrig {
namespace {

/// Runs of bearing A whose coils open at 20 ms, 40 ms and so on; the shaft touches at `contact`.
struct Fallen {
  explicit Fallen(const std::string& coils) {
    folder.Write("c.toml",
                 "name = \"t\"\nrig = \"rig.toml\"\nduration = 0.2\n[faults]\nbearings = [\"A\"]\n"
                 "onset = [\"sequential\"]\nspacing = 0.02\ntime = 0.02\nsets = [" +
                     coils + "]\n");
    plan = std::make_unique<RunPlan>(ReadCampaign(folder.File("c.toml")));
    p = plan->Make(0);
  }
  std::string Reason(double contact, const std::vector<int>& found,
                     const std::vector<CoilAction>& actions = {}) const {
    RunResult r;
    double t = 0.0201;
    for (const int coil : found) {
      r.events.push_back({t, "detected", "A.coil" + std::to_string(coil), "", 0});
      t += 0.02;
    }
    r.events.push_back({contact, "touchdown", "A", "", 0});
    r.actions = actions;
    return DropReason(*plan, p, r);
  }
  testing::CampaignFolder folder;
  std::unique_ptr<RunPlan> plan;
  PlannedRun p;
};

TEST(DropReason, IsThatWhichComesFirst) {
  const Fallen pair("[3, 6]");
  ASSERT_TRUE(pair.p.margin);
  EXPECT_NEAR(*pair.p.margin, 2.03, 0.1);  // as `ambrig redistribute` says
  EXPECT_EQ(pair.Reason(0.01, {}), "bounced before");
  EXPECT_EQ(pair.Reason(0.03, {}), "fault not detected");
  EXPECT_EQ(pair.Reason(0.05, {3}), "fault not detected");
  EXPECT_EQ(pair.Reason(0.05, {3, 6}), "transition");
  const CoilAction false_one{0.045, "A.coil5", "derate", ""};
  EXPECT_EQ(pair.Reason(0.05, {3, 6}, {false_one}), "healthy coil given up");
  EXPECT_EQ(pair.Reason(0.042, {3, 6}, {false_one}), "transition");  // it came later
  EXPECT_EQ(pair.Reason(0.05, {3, 6}, {{0.045, "A.coil6", "disable", ""}}), "transition");
}

// What counts are the coils left when the shaft touched, not those that failed afterwards.
TEST(DropReason, ComesFromTheCoilsLeftAtTheContact) {
  const Fallen three("[1, 2, 3]");
  ASSERT_TRUE(three.p.margin);
  EXPECT_EQ(*three.p.margin, 0);
  EXPECT_EQ(three.Reason(0.07, {1, 2, 3}), "load not carried");
  EXPECT_EQ(three.Reason(0.05, {1, 2}), "transition");
}

TEST(DropReason, OfARunThatStayedUpThereIsNone) {
  const Fallen pair("[3, 6]");
  EXPECT_EQ(DropReason(*pair.plan, pair.p, {}), "");
}

}  // namespace
}  // namespace ambrig
