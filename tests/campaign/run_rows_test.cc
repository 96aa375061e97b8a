// Which runs are whose, and that all cores together do each of them once.
#include "campaign/run_rows.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "core/base/errors.h"
#include "tests/core/temporary_folder.h"

namespace ambrig::testing {
namespace {

TEST(Shards, AreNamedByTheirNumberAndHowManyThereAre) {
  const Shard second = ParseShard("2/4");
  EXPECT_EQ(second.index, 1u);
  EXPECT_EQ(second.count, 4u);
  EXPECT_EQ(ParseShard("1/1").count, 1u);
  for (const char* wrong :
       {"", "2", "/", "0/4", "5/4", "-1/4", "1/4x", "1.0/4", "a/b", "1/0", " 1/4"})
    EXPECT_EQ(ErrorText<InputError>([&] { ParseShard(wrong); }),
              std::string("--shard = ") + wrong + ", allowed: i/n with 1 <= i <= n, e.g. 2/4");
}

// Any number of shards: every run is one's and nobody else's, and none has two more than another.
TEST(Shards, ShareTheRunsOut) {
  for (const std::size_t count : {1u, 3u, 7u}) {
    std::vector<int> taken(20, 0);
    std::size_t least = 100, most = 0;
    for (std::size_t index = 0; index < count; ++index) {
      const Shard shard{index, count};
      const auto runs = PendingRuns(taken.size(), shard, {});
      for (const std::size_t run : runs) {
        ++taken[run];
        EXPECT_TRUE(shard.Has(run));
      }
      least = std::min(least, runs.size());
      most = std::max(most, runs.size());
    }
    EXPECT_EQ(taken, std::vector<int>(taken.size(), 1)) << count;
    EXPECT_LE(most - least, 1u);
  }
}

TEST(Shards, KeepTheRunsOfABlockTogether) {
  std::vector<int> of(24, -1);
  for (std::size_t index = 0; index < 3; ++index)
    for (const std::size_t run : PendingRuns(of.size(), Shard{index, 3, 4}, {})) {
      EXPECT_EQ(of[run], -1) << run;
      of[run] = static_cast<int>(index);
    }
  for (std::size_t run = 0; run < of.size(); ++run)
    EXPECT_EQ(of[run], static_cast<int>(run / 4 % 3)) << run;
}

// Two scenarios and ten machines, each with and without having been commissioned: four runs a
// machine.
TEST(RunsTogether, AreThoseOfAMachineWhereThereAreEnoughForAllWorkers) {
  Campaign c;
  c.scenarios.resize(2);
  c.cases.resize(1);
  c.draws.resize(1);
  EXPECT_EQ(c.RunsTogether(1), 1u);  // no plants
  c.plants.resize(20);
  for (std::size_t k = 1; k < c.plants.size(); k += 2) c.plants[k].commissioned = true;
  ASSERT_EQ(c.runs(), 40u);
  EXPECT_EQ(c.RunsTogether(1), 4u);
  EXPECT_EQ(c.RunsTogether(2), 1u);
}

TEST(PendingRuns, AreThoseThatTheJournalDoesNotHold) {
  std::map<std::size_t, Row> done;
  for (const std::size_t run : {0u, 3u, 5u}) done[run] = Row{};
  EXPECT_EQ(PendingRuns(6, {}, done), (std::vector<std::size_t>{1, 2, 4}));
  EXPECT_EQ(PendingRuns(6, {1, 2}, done), (std::vector<std::size_t>{1}));
  EXPECT_TRUE(PendingRuns(0, {}, done).empty());
}

TEST(OnAllCores, DoesEveryRunOnceForAnyNumberOfThreads) {
  std::vector<std::size_t> runs;
  for (std::size_t k = 0; k < 200; ++k) runs.push_back(3 * k);
  for (const int jobs : {1, 2, 5, 0}) {
    std::mutex lock;
    std::multiset<std::size_t> seen;
    OnAllCores(runs, jobs, nullptr, [&](std::size_t run) {
      const std::lock_guard guard(lock);
      seen.insert(run);
    });
    EXPECT_EQ(seen, (std::multiset<std::size_t>(runs.begin(), runs.end()))) << jobs;
  }
}

TEST(OnAllCores, OneThreadKeepsTheirOrder) {
  std::vector<std::size_t> seen;
  const std::vector<std::size_t> runs = {5, 1, 4, 2};
  OnAllCores(runs, 1, nullptr, [&](std::size_t run) { seen.push_back(run); });
  EXPECT_EQ(seen, runs);
}

// What goes wrong in one ends all, and is what the caller is told.
TEST(OnAllCores, TheFirstExceptionEndsAll) {
  std::vector<std::size_t> runs(1000);
  for (std::size_t k = 0; k < runs.size(); ++k) runs[k] = k;
  std::atomic<int> begun{0};
  const std::string said = ErrorText<InputError>([&] {
    OnAllCores(runs, 2, nullptr, [&](std::size_t run) {
      ++begun;
      if (run == 3) throw InputError("run 3 cannot be written");
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // what a run takes at least
    });
  });
  EXPECT_EQ(said, "run 3 cannot be written");
  EXPECT_LT(begun, 1000);
}

TEST(OnAllCores, AStopIsAnInterruption) {
  std::atomic<bool> stop{false};
  std::atomic<int> begun{0};
  const std::vector<std::size_t> runs(1000, 7);
  EXPECT_THROW(OnAllCores(runs, 2, &stop,
                          [&](std::size_t) {
                            if (++begun == 5) stop = true;
                          }),
               Interrupted);
  EXPECT_LT(begun, 20);
  begun = 0;
  EXPECT_THROW(OnAllCores(runs, 1, &stop, [&](std::size_t) { ++begun; }), Interrupted);
  EXPECT_EQ(begun, 0);
}

}  // namespace
}  // namespace ambrig::testing
