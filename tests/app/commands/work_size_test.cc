// What a campaign or an explain will cost, before it starts: proportional to what there is to do,
// refused beyond a day or the memory, said beyond a minute.
#include "app/commands/work_size.h"

#include <gmock/gmock.h>

#include "app/commands/run_size.h"
#include "core/base/errors.h"
#include "tests/campaign/campaign_folder.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

using testing::ErrorText;
using ::testing::HasSubstr;

class CampaignWork : public ::testing::Test {
 protected:
  Campaign Read(const std::string& more = "") const {
    folder_.Write("c.toml", testing::kSmallCampaign + more);
    return ReadCampaign(folder_.File("c.toml"));
  }
  testing::CampaignFolder folder_;
};

// 32 runs of 10 ms of the reference rig after 0.25 s of warm-up, six times as fast as real time:
// 1.4 s.
TEST_F(CampaignWork, IsTheRunsThatAreLeftOverTheCores) {
  const Campaign c = Read();
  ASSERT_EQ(c.runs(), 32u);
  const WorkSize all = CampaignSize(c, 32, 1), half = CampaignSize(c, 16, 1),
                 two = CampaignSize(c, 32, 2), none = CampaignSize(c, 0, 2);
  EXPECT_NEAR(all.seconds, 32 * 0.26 / 6, 1e-9);
  EXPECT_DOUBLE_EQ(half.seconds, all.seconds / 2);
  EXPECT_DOUBLE_EQ(two.seconds, all.seconds / 2);
  EXPECT_EQ(two.cores, 2u);
  EXPECT_EQ(none.seconds, 0);
  EXPECT_GE(CampaignSize(c, 32, 0).cores, 1u);  // 0: all of them
}

TEST_F(CampaignWork, CountsTheRunsWithoutFaultToleranceAndTheCommissioning) {
  Campaign c = Read();
  c.plants.resize(2);
  const double runs = CampaignSize(c, c.runs(), 1).seconds;
  c.without = true;
  EXPECT_DOUBLE_EQ(CampaignSize(c, c.runs(), 1).seconds, 2 * runs);
  c.plants[1].commissioned =
      true;  // 20 runs of 0.4 s after 0.25 s of warm-up, six times as fast as real time
  EXPECT_NEAR(CampaignSize(c, c.runs(), 1).seconds, 2 * runs + 20 * 0.65 / 6, 1e-9);
  EXPECT_NEAR(CampaignSize(c, c.runs() / 2, 1).seconds, runs + 10 * 0.65 / 6, 1e-9);
}

// As many records at once as there are threads, but no more than there are runs.
TEST_F(CampaignWork, MemoryIsThatOfTheRunsAtOnce) {
  const Campaign c = Read();
  const double one = RunMemory(c.rig, c.scenarios.front(), 0);
  EXPECT_DOUBLE_EQ(CampaignSize(c, 32, 1).bytes, one);
  EXPECT_DOUBLE_EQ(CampaignSize(c, 32, 4).bytes, 4 * one);
  EXPECT_DOUBLE_EQ(CampaignSize(c, 2, 4).bytes, 2 * one);
}

TEST_F(CampaignWork, TheMeanOfUnequalScenariosCounts) {
  Campaign c = Read();
  c.scenarios.push_back(c.scenarios.front());
  c.scenarios.back().duration = 0.03;
  EXPECT_NEAR(CampaignSize(c, 10, 1).seconds, 10 * 0.27 / 6, 1e-9);
  EXPECT_DOUBLE_EQ(CampaignSize(c, 10, 1).bytes, RunMemory(c.rig, c.scenarios.back(), 0));
}

TEST(ExplainWork, GrowsWithRecordsAndRows) {
  const LinearCase two({1e-5, 2e-5}, 1, 0), four({1e-5, 2e-5, 3e-5, 4e-5}, 1, 0);
  const WorkSize a = ExplainSize(two.data), b = ExplainSize(four.data);
  EXPECT_NEAR(b.seconds, 2 * a.seconds, 1e-9);
  // 800 simulations a record of 4 ms, each a fifth of a run with everything on, on all cores
  EXPECT_NEAR(a.seconds,
              2 * 800 * 0.2 * RunSeconds(two.data.rig, two.data.records[0].scenario) / a.cores,
              1e-9);
  EXPECT_GT(b.bytes, a.bytes);
  Case longer = two.data;
  for (CaseRecord& r : longer.records)
    for (Channel& ch : r.data.channels) ch.samples.resize(1'000'000);
  // 120 columns of 8 bytes for each of 4 million numbers
  EXPECT_NEAR(ExplainSize(longer).bytes - a.bytes, 4e6 * 8 * 120, 1e6);
}

WorkSize Size(double seconds, double bytes = 0, unsigned cores = 2) {
  WorkSize s;
  s.seconds = seconds;
  s.bytes = bytes;
  s.cores = cores;
  return s;
}

std::string Said(const WorkSize& size, bool long_runs, std::string* printed = nullptr) {
  ::testing::internal::CaptureStdout();
  const std::string error =
      ErrorText<InputError>([&] { CheckWorkSize("c.toml", size, long_runs); });
  const std::string out = ::testing::internal::GetCapturedStdout();
  if (printed) *printed = out;
  return error;
}

TEST(WorkSizeCheck, AMinuteIsNotWorthAWord) {
  std::string printed;
  EXPECT_EQ(Said(Size(59), false, &printed), "");
  EXPECT_EQ(printed, "");
  EXPECT_EQ(Said(Size(720), false, &printed), "");
  EXPECT_EQ(printed, "c.toml: about 12 min on 2 cores\n");
  EXPECT_EQ(Said(Size(720, 0, 1), false, &printed), "");
  EXPECT_EQ(printed, "c.toml: about 12 min on 1 core\n");
}

TEST(WorkSizeCheck, ADayIsRefusedUnlessAskedFor) {
  EXPECT_EQ(Said(Size(25 * 3600), false),
            "c.toml: would take about 25.0 h on 2 cores, allowed: 24.0 h unless --long is given");
  std::string printed;
  EXPECT_EQ(Said(Size(25 * 3600), true, &printed), "");
  EXPECT_THAT(printed, HasSubstr("about 25.0 h"));
}

// --long asks for time, not for memory that is not there.
TEST(WorkSizeCheck, MemoryThatIsNotThereIsRefusedAnyway) {
  for (const bool long_runs : {false, true})
    EXPECT_THAT(Said(Size(1, 1e15), long_runs),
                ::testing::MatchesRegex("c\\.toml: needs about 1000000\\.0 GB, allowed: "
                                        "[0-9.]+ GB of free memory .*"));
}

// The command: nothing is begun, nothing is written.
TEST_F(CampaignWork, TheCommandRefusesBeforeItStarts) {
  std::string slow = testing::kSmallCampaign;
  slow.replace(slow.find("duration = 0.01"), 15, "duration = 1e5 ");
  folder_.Write("slow.toml", slow);
  const testing::Outcome o = folder_.Ambrig("campaign slow.toml --jobs 1 -o out");
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_THAT(o.text, HasSubstr("slow.toml: "));
  EXPECT_THAT(o.text, HasSubstr("allowed: "));
  EXPECT_EQ(o.text.find("run 0"), std::string::npos);
}

}  // namespace
}  // namespace ambrig
