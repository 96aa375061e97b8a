// Work of the server that lasts: a watched folder, a campaign, the playground, a full disk, kill -9
// in an adoption.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/workbench/http_client.h"

namespace ambrig::workbench {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class ServeWork : public ServedBench {
 protected:
  void SetUp() override {
    ServedBench::SetUp();
    fs::copy(AMBRIG_SOURCE_DIR "/examples/mls2em", base_ / "served" / "ball",
             fs::copy_options::recursive);
    fs::copy_file(AMBRIG_SOURCE_DIR "/scenarios/library/rigs/reference.toml",
                  base_ / "served" / "rig.toml");
    Write("served/short.toml",
          "name = \"short\"\nrig = \"rig.toml\"\nduration = 0.01\nrecord_rate = 12500.0\n");
  }
  int Start(const nlohmann::json& order) {
    const Answer a = Ask("POST", "/api/jobs", order.dump());
    EXPECT_EQ(a.status, 202) << a.body;
    return a.status == 202 ? a.Json()["id"].get<int>() : 0;
  }
  nlohmann::json WaitFor(const std::string& path,
                         const std::function<bool(const nlohmann::json&)>& is) {
    nlohmann::json found;
    for (int k = 0; k < 600; ++k) {
      found = Ask("GET", path).Json();
      if (is(found)) return found;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    ADD_FAILURE() << path << ": " << found.dump().substr(0, 500);
    return found;
  }
};

// A record that a logger writes is examined without anybody asking, and a page hears of it.
TEST_F(ServeWork, AWatchedFolderIsExaminedAsItFills) {
  fs::create_directories(base_ / "served" / "logger");
  ServedBench::Serve();
  EXPECT_EQ(Ask("POST", "/api/watched", R"({"case":"ball/case.toml","folder":"../other"})").status,
            400);
  EXPECT_EQ(Ask("POST", "/api/watched", R"({"case":"ball/case.toml","folder":"logger"})").status,
            200);
  fs::copy_file(base_ / "served/ball/data/inductance_em1_05.csv",
                base_ / "served/logger/inductance_em1_05-may.csv");
  fs::last_write_time(base_ / "served/logger/inductance_em1_05-may.csv",
                      fs::file_time_type::clock::now() - std::chrono::seconds(60));
  const nlohmann::json found = WaitFor(
      "/api/result?kind=watch&p=ball/case.toml",
      [](const nlohmann::json& r) { return r.is_object() && !r["result"]["records"].empty(); });
  const nlohmann::json& record = found["result"]["records"][0];
  EXPECT_EQ(record["data"], "inductance_em1_05-may.csv");
  EXPECT_EQ(record["state"], "ok") << record["left"];  // the same record again
  EXPECT_EQ(Ask("GET", "/api/folder").Json()["cases"][0]["watch"]["left"], 0);
  // It is remembered, and can be ended.
  EXPECT_EQ(Kill(SIGKILL), 128 + SIGKILL);
  ServedBench::Serve();
  EXPECT_EQ(Ask("GET", "/api/watched").Json()[0]["folder"], "logger");
  Ask("POST", "/api/watched", R"({"case":"ball/case.toml","folder":"logger","on":false})");
  EXPECT_TRUE(Ask("GET", "/api/watched").Json().empty());
}

TEST_F(ServeWork, ACampaignShowsItsRowsAndARowIsRunAgain) {
  Write("served/c.toml", "name = \"c\"\nrig = \"rig.toml\"\nduration = 0.01\nseeds = 3\n");
  ServedBench::Serve();
  const int job = Start({{"command", "campaign"}, {"campaign", "c.toml"}});
  EXPECT_EQ(Ended(job)["state"], "done");
  const nlohmann::json rows = Ask("GET", "/api/rows?job=" + std::to_string(job)).Json();
  EXPECT_EQ(rows["runs"], 3) << rows;
  EXPECT_EQ(rows["rows"].size(), 3u);
  EXPECT_EQ(rows["columns"][0], "run");
  EXPECT_EQ(Ask("GET", "/api/rows?job=" + std::to_string(job) + "&from=2").Json()["rows"].size(),
            1u);
  EXPECT_EQ(Ask("GET", "/api/rows?job=99").status, 404);
  const int row = Start({{"command", "row"}, {"campaign", "c.toml"}, {"row", 2}});
  EXPECT_EQ(Ended(row)["state"], "done");
  EXPECT_EQ(Ask("GET", "/api/series?job=" + std::to_string(row) + "&run=c_row_2.h5").status, 200);
  EXPECT_EQ(Ask("POST", "/api/ticket", "{\"job\":" + std::to_string(row) + "}").status, 200);
}

TEST_F(ServeWork, RunsOfThePlaygroundLeaveTheFolderAsItIs) {
  ServedBench::Serve();
  const auto files = [&] { return Ask("GET", "/api/folder").Json()["files"].size(); };
  const auto before = files();
  const std::string text = Text("served/short.toml");
  const int a =
      Start({{"command", "play"}, {"scenario", {{"beside", "short.toml"}, {"text", text}}}});
  EXPECT_EQ(Ended(a)["state"], "done");
  const int b = Start({{"command", "play"},
                       {"scenario", {{"beside", "short.toml"}, {"text", "seed = 2\n" + text}}}});
  EXPECT_EQ(Ended(b)["state"], "done");
  EXPECT_EQ(files(), before);
  const int d = Start({{"command", "difference"}, {"a", a}, {"b", b}});
  EXPECT_EQ(Ended(d)["state"], "done");
  const nlohmann::json difference = Ask("GET", "/api/jobs/" + std::to_string(d) + "/result").Json();
  EXPECT_EQ(difference["identical"], false);
  EXPECT_EQ(Ask("POST", "/api/jobs", R"({"command":"difference","a":99,"b":1})").status, 400);
}

// Files that may not grow beyond 32 KiB: everything that does not fit is refused with its reason,
// nothing half-written stays, the server goes on.
TEST_F(ServeWork, AFullDiskIsAnErrorAndNoMore) {
  ServedBench::Serve("ulimit -f 64; ");
  const std::string large(200000, 'x');
  EXPECT_EQ(Ask("PUT", "/api/file?p=new.txt", "small").status, 200);
  const Answer file = Ask("PUT", "/api/file?p=large.txt", large);
  EXPECT_GE(file.status, 400) << file.body;
  const Answer upload = Ask("PUT", "/api/upload?p=log.csv", large);
  EXPECT_GE(upload.status, 400) << upload.body;
  EXPECT_FALSE(fs::exists(base_ / "served/large.txt"));
  EXPECT_FALSE(fs::exists(base_ / "served/log.csv"));
  for (const auto& entry : fs::directory_iterator(base_ / "served"))
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
  const nlohmann::json job = Ended(Start({{"command", "run"}, {"scenario", "short.toml"}}));
  EXPECT_EQ(job["state"], "failed") << job;
  EXPECT_THAT(job["error"].get<std::string>(), HasSubstr("cannot write"));
  EXPECT_EQ(Ask("GET", "/api/file?p=new.txt").body, "small");
  EXPECT_EQ(Kill(SIGINT), 0);
}

// Whenever it is killed: the case is as it was, the new files are whole or absent, and the same
// click afterwards gives them.
TEST_F(ServeWork, KilledInTheMiddleOfAnAdoption) {
  const std::string rig = Text("served/ball/rig.toml"), case_text = Text("served/ball/case.toml");
  const nlohmann::json order = {{"command", "adopt"},
                                {"case", "ball/case.toml"},
                                {"effect", "freewheel-drop"},
                                {"rig", "ball/rig_2.toml"},
                                {"new_case", "ball/case_2.toml"}};
  for (const int wait : {100, 500, 1500}) {
    ServedBench::Serve();
    const int id = Start(order);
    std::this_thread::sleep_for(std::chrono::milliseconds(wait));
    Kill(SIGKILL);
    EXPECT_EQ(Text("served/ball/rig.toml"), rig);
    EXPECT_EQ(Text("served/ball/case.toml"), case_text);
    ServedBench::Serve();
    const std::string state = Ask("GET", "/api/jobs/" + std::to_string(id)).Json()["state"];
    EXPECT_TRUE(state == "interrupted" || state == "done") << state;
    Kill(SIGINT);
    if (fs::exists(base_ / "served/ball/case_2.toml")) break;  // it was faster
  }
  ServedBench::Serve();
  if (!fs::exists(base_ / "served/ball/rig_2.toml")) {
    EXPECT_EQ(Ended(Start(order))["state"], "done");
  }
  EXPECT_THAT(Text("served/ball/rig_2.toml"), HasSubstr("freewheel-drop"));
  EXPECT_THAT(Text("served/ball/case_2.toml"), HasSubstr("rig_2.toml"));
}

TEST_F(ServeWork, FifosAndLinksAreNotOpened) {
  ASSERT_EQ(::mkfifo((base_ / "served/pipe.csv").c_str(), 0600), 0);
  fs::create_directory_symlink(base_ / "other", base_ / "served/way");
  fs::create_symlink(base_ / "other/secret.toml", base_ / "served/link.toml");
  ServedBench::Serve();
  for (const char* path : {"pipe.csv", "way/secret.toml", "link.toml"}) {
    EXPECT_EQ(Ask("GET", std::string("/api/file?p=") + path).status, 400) << path;
    EXPECT_EQ(Ask("GET", std::string("/api/series?p=") + path).status, 400) << path;
    EXPECT_EQ(Ask("PUT", std::string("/api/upload?p=") + path, "x").status, 400) << path;
  }
  EXPECT_EQ(Ask("PUT", "/api/file?p=way/new.toml", "x = 1\n").status, 400);
  EXPECT_EQ(Text("other/secret.toml"), "secret = 1\n");
  EXPECT_THAT(Ask("GET", "/api/folder").body, ::testing::Not(HasSubstr("secret.toml")));
}

}  // namespace
}  // namespace ambrig::workbench
