// Jobs and what is known of their results, with a shell script in the place of the program.
#include "workbench/jobs.h"

#include <gmock/gmock.h>

#include <csignal>
#include <thread>

#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "tests/workbench/bench_folder.h"
#include "workbench/child_process.h"
#include "workbench/folder_index.h"

namespace ambrig::workbench {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class JobsOf : public BenchFolder {
 protected:
  void SetUp() override {
    BenchFolder::SetUp();
    Write("served/rig.toml", "name = \"r\"\n[rotor]\nmass = 1\n[bearings.A]\nz = 0\n");
    Write("served/other.toml", "name = \"o\"\n[rotor]\nmass = 2\n[bearings.A]\nz = 0\n");
    Program("");
  }

  /// The program: `$result` is where it should write its JSON.
  void Program(const std::string& body) {
    Write(
        "program",
        "#!/bin/sh\nwhile [ $# -gt 0 ]; do [ \"$1\" = --json ] && result=$2; shift; done\n" + body);
    std::filesystem::permissions(base_ / "program", std::filesystem::perms::owner_all);
  }
  std::string program() const { return (base_ / "program").string(); }

  /// The state that a job is in when it has ended.
  static json Ended(const Jobs& jobs, int id) {
    for (int k = 0; k < 3000; ++k) {
      json state = jobs.State(id);
      if (state.is_null() || (state["state"] != "running" && state["state"] != "queued"))
        return state;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "job " << id << " does not end";
    return {};
  }
  /// Waits until the program has begun, which then holds the file `begun`.
  void Begun() const {
    for (int k = 0; k < 3000 && !std::filesystem::exists(base_ / "served" / "begun"); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(std::filesystem::exists(base_ / "served" / "begun"));
  }

  static constexpr const char* kWaits =
      "touch begun; trap 'exit 130' INT; while :; do sleep 0.05; done\n";
};

TEST_F(JobsOf, AChildReadsNothingSaysItsLinesAndItsCode) {
  Program("read x; echo out; echo err >&2; printf 'one\\ntwo\\nthree' >&3; exit 7\n");
  std::vector<std::string> lines;
  int pid = 0;
  const ChildEnd end = RunChild(
      program(), {}, served(), (base_ / "log").string(), 0, [&](int p) { pid = p; },
      [&](const std::string& line) { lines.push_back(line); });
  EXPECT_EQ(end.code, 7);
  EXPECT_GT(pid, 0);
  EXPECT_THAT(lines, ElementsAre("one", "two"));  // the third has no end
  EXPECT_EQ(Text("log"), "out\nerr\n");
}

TEST_F(JobsOf, AChildThatASignalEndedHasItsNumber) {
  Program("kill -9 $$\n");
  const auto ignore = [](const auto&) {};
  EXPECT_EQ(RunChild(program(), {}, served(), (base_ / "log").string(), 0, ignore, ignore).code,
            128 + SIGKILL);
  EXPECT_THROW(RunChild((base_ / "none").string(), {}, served(), (base_ / "log").string(), 0,
                        ignore, ignore),
               InputError);
}

TEST_F(JobsOf, AJobRunsInTheFolderAndItsEventsCarryItsNumber) {
  Program(
      "pwd; echo '{\"event\":\"progress\",\"share\":0.5}' >&3; echo nonsense >&3; echo '{}' > "
      "$result\n");
  EventLog events;
  const ServedFolder folder(served());
  Jobs jobs(folder, program(), events);
  const json started = jobs.Start({{"command", "rig"}, {"rig", "rig.toml"}});
  EXPECT_EQ(started["id"], 1);
  EXPECT_THAT(
      started["argv"].get<std::vector<std::string>>(),
      ElementsAre("rig", "rig.toml", "--json", ".ambrig/jobs/1/result.json", "--events", "3"));
  const json done = Ended(jobs, 1);
  EXPECT_EQ(done["state"], "done");
  EXPECT_EQ(done["code"], 0);
  EXPECT_EQ(Text("served/.ambrig/jobs/1/log.txt"),
            std::filesystem::canonical(served()).string() + "\n");
  EXPECT_EQ(Text("served/.ambrig/jobs/1/events.jsonl"), "{\"event\":\"progress\",\"share\":0.5}\n");
  std::uint64_t seq = 0;
  const std::string told = events.After(&seq, std::chrono::milliseconds(0));
  EXPECT_THAT(told, HasSubstr("\"event\":\"progress\",\"share\":0.5,\"job\":1"));
  EXPECT_EQ(jobs.Latest("rig", "rig.toml"), 1);
  EXPECT_EQ(jobs.Latest("rig", "other.toml"), 0);
  EXPECT_EQ(jobs.Latest("run", "rig.toml"), 0);
}

// 1 is an answer (an expectation does not hold); every other code is a failure with the program's
// own words.
TEST_F(JobsOf, CodesAndErrors) {
  EventLog events;
  const ServedFolder folder(served());
  Jobs jobs(folder, program(), events);
  Program("exit 1\n");
  jobs.Start({{"command", "rig"}, {"rig", "rig.toml"}});
  EXPECT_EQ(Ended(jobs, 1)["state"], "done");
  Program("echo '{\"event\":\"done\",\"error\":\"rig.toml, line 2: mass\"}' >&3; exit 2\n");
  jobs.Start({{"command", "rig"}, {"rig", "rig.toml"}});
  const json failed = Ended(jobs, 2);
  EXPECT_EQ(failed["state"], "failed");
  EXPECT_EQ(failed["code"], 2);
  EXPECT_EQ(failed["error"], "rig.toml, line 2: mass");
  EXPECT_TRUE(jobs.State(3).is_null());
  EXPECT_THROW(jobs.Start({{"command", "rig"}, {"rig", "none.toml"}}), InputError);
}

TEST_F(JobsOf, TheSameWorkIsSharedWhileItRunsAndStoppedOnce) {
  Program(kWaits);
  EventLog events;
  const ServedFolder folder(served());
  Jobs jobs(folder, program(), events);
  jobs.Start({{"command", "rig"}, {"rig", "rig.toml"}});
  Begun();
  EXPECT_EQ(jobs.Start({{"command", "rig"}, {"rig", "rig.toml"}})["id"], 1);
  EXPECT_EQ(jobs.Start({{"command", "rig"}, {"rig", "other.toml"}})["id"], 2);
  EXPECT_TRUE(jobs.Stop(1));
  EXPECT_EQ(Ended(jobs, 1)["state"], "stopped");
  EXPECT_EQ(jobs.State(1)["code"], 130);
  EXPECT_FALSE(jobs.Stop(1));
  EXPECT_FALSE(jobs.Stop(9));
  EXPECT_TRUE(jobs.Stop(2));
  EXPECT_EQ(Ended(jobs, 2)["state"], "stopped");
}

// Two light jobs run at once; the third waits, and is gone without having begun when it is stopped
// then.
TEST_F(JobsOf, AWaitingJobIsStoppedWithoutBeginning) {
  Program(kWaits);
  Write("served/third.toml", "name = \"t\"\n");
  EventLog events;
  const ServedFolder folder(served());
  Jobs jobs(folder, program(), events);
  for (const char* rig : {"rig.toml", "other.toml", "third.toml"})
    jobs.Start({{"command", "rig"}, {"rig", rig}});
  Begun();
  EXPECT_EQ(jobs.State(3)["state"], "queued");
  EXPECT_TRUE(jobs.Stop(3));
  EXPECT_EQ(jobs.State(3)["state"], "stopped");
  EXPECT_FALSE(std::filesystem::exists(base_ / "served/.ambrig/jobs/3/log.txt"));
  jobs.Stop(1);
  jobs.Stop(2);
  Ended(jobs, 1);
  Ended(jobs, 2);
}

TEST_F(JobsOf, WhatRanWhenTheServerEndedIsInterruptedAndItsNumberNotUsedAgain) {
  Program(kWaits);
  const ServedFolder folder(served());
  {
    EventLog events;
    Jobs jobs(folder, program(), events);
    jobs.Start({{"command", "rig"}, {"rig", "rig.toml"}});
    Begun();
  }
  std::filesystem::create_directories(base_ / "served/.ambrig/jobs/2");  // a crash left no state
  Program("");
  EventLog events;
  Jobs jobs(folder, program(), events);
  EXPECT_EQ(jobs.State(1)["state"], "interrupted");
  EXPECT_EQ(jobs.All().size(), 1u);
  EXPECT_EQ(jobs.Start({{"command", "rig"}, {"rig", "rig.toml"}})["id"], 3);
  EXPECT_EQ(Ended(jobs, 3)["state"], "done");
}

// Each change in the playground makes runs: the newest stay, what is no run of it stays whatever
// comes.
TEST_F(JobsOf, OldRunsOfThePlaygroundAreForgotten) {
  Write("served/s.toml", "rig = \"rig.toml\"\nduration = 1.0\n");
  const ServedFolder folder(served());
  const auto run = [](int k) {
    return json{
        {"command", "play"},
        {"scenario", {{"beside", "s.toml"}, {"text", "seed = " + std::to_string(k) + "\n"}}}};
  };
  {
    EventLog events;
    Jobs jobs(folder, program(), events);
    Ended(jobs, jobs.Start({{"command", "rig"}, {"rig", "rig.toml"}})["id"]);
    for (int k = 0; k < Jobs::kRunsKept + 3; ++k) Ended(jobs, jobs.Start(run(k))["id"]);
    EXPECT_EQ(jobs.All().size(), Jobs::kRunsKept + 1u);
    EXPECT_EQ(jobs.State(1)["command"], "rig");
    EXPECT_TRUE(jobs.State(4).is_null());
    EXPECT_EQ(jobs.State(5)["state"], "done");
    EXPECT_FALSE(std::filesystem::exists(jobs.FolderOf(4)));
    EXPECT_TRUE(std::filesystem::exists(jobs.FolderOf(5)));
  }
  EventLog events;
  Jobs jobs(folder, program(), events);
  EXPECT_EQ(jobs.All().size(), Jobs::kRunsKept + 1u);
  EXPECT_EQ(jobs.Start(run(-1))["id"], Jobs::kRunsKept + 5);  // no number is used again
}

TEST_F(JobsOf, TheIndexTellsKindsByWhatFilesHold) {
  Write("served/case.toml",
        "rig = \"rig.toml\"\n[[record]]\ndata = \"b.csv\"\n[[record]]\ndata = \"b.csv\"\n");
  Write("served/s.toml", "rig = \"rig.toml\"\nduration = 1.0\n");
  Write("served/c.toml", "scenarios = []\n");
  Write("served/broken.toml", "x = = 1\n");
  Write("served/page.html", "<p>\n");
  EventLog events;
  const ServedFolder folder(served());
  Jobs jobs(folder, program(), events);
  FolderIndex index(folder, jobs);
  std::map<std::string, std::string> kinds;
  const json all = index.Folder();
  for (const auto& f : all["files"]) kinds[f["name"]] = f["kind"];
  EXPECT_EQ(kinds["rig.toml"], "rig");
  EXPECT_EQ(kinds["case.toml"], "case");
  EXPECT_EQ(kinds["s.toml"], "scenario");
  EXPECT_EQ(kinds["c.toml"], "campaign");
  EXPECT_EQ(kinds["broken.toml"], "broken");
  EXPECT_EQ(kinds["a.toml"], "other");
  EXPECT_EQ(kinds["sub/b.csv"], "record");
  EXPECT_EQ(kinds["page.html"], "report");
  ASSERT_EQ(all["cases"].size(), 1u);
  EXPECT_EQ(all["cases"][0]["records"], 2);
  EXPECT_EQ(all["cases"][0]["rig"], "rig.toml");
  EXPECT_TRUE(all["cases"][0]["compare"].is_null());
  Write("served/s.toml", "rig = \"rig.toml\"\nrecord_rate = 1.0\n");  // is looked at again
  const json again = index.Folder();
  for (const json& f : again["files"]) kinds[f["name"]] = f["kind"];
  EXPECT_EQ(kinds["s.toml"], "other");
}

// A result is fresh as long as the files have the hashes that it was made with.
TEST_F(JobsOf, AResultIsStaleOnceAnInputChanges) {
  const std::string rig = Text("served/rig.toml");
  Program("echo '{\"ratio\":2.5,\"provenance\":{\"inputs\":{\"./rig.toml\":\"" + HashText(rig) +
          "\"}}}' > $result\n");
  EventLog events;
  const ServedFolder folder(served());
  Jobs jobs(folder, program(), events);
  FolderIndex index(folder, jobs);
  EXPECT_TRUE(index.Result("rig", "rig.toml").is_null());
  jobs.Start({{"command", "rig"}, {"rig", "rig.toml"}});
  Ended(jobs, 1);
  json result = index.Result("rig", "rig.toml");
  EXPECT_EQ(result["job"], 1);
  EXPECT_EQ(result["fresh"], true);
  EXPECT_EQ(result["result"]["ratio"], 2.5);
  Write("served/rig.toml", rig + "# more\n");
  result = index.Result("rig", "rig.toml");
  EXPECT_EQ(result["fresh"], false);
  EXPECT_EQ(result["stale"], json({"./rig.toml"}));
  Write("served/rig.toml", rig);
  EXPECT_EQ(json(index.Result("rig", "rig.toml"))["fresh"], true);
  EXPECT_EQ(index.HashOf("none.toml"), "");
  EXPECT_EQ(index.HashOf("../other/secret.toml"), "");
}

}  // namespace
}  // namespace ambrig::workbench
