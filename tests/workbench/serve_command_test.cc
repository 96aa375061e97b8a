// The server as others meet it: other pages, other users, broken and random requests, many clients,
// kill -9.
#include <gmock/gmock.h>

#include <atomic>
#include <random>

#include "tests/workbench/http_client.h"

namespace ambrig::workbench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Serve : public ServedBench {
 protected:
  void SetUp() override {
    ServedBench::SetUp();
    std::filesystem::copy_file(AMBRIG_SOURCE_DIR "/scenarios/library/rigs/reference.toml",
                               base_ / "served" / "rig.toml");
    Write("served/short.toml",
          "name = \"short\"\nrig = \"rig.toml\"\nduration = 0.01\nrecord_rate = 12500.0\n");
    ServedBench::Serve();
  }
  std::string With(const std::string& host, const std::string& more) const {
    return "GET /api/folder HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n" + more +
           "\r\n";
  }
  std::string Token() const { return "Authorization: Bearer " + token_ + "\r\n"; }
};

TEST_F(Serve, ThePageHoldsNothingOfTheFolder) {
  const Answer page = Parsed(Raw("GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"));
  EXPECT_EQ(page.status, 200);
  EXPECT_THAT(page.head, HasSubstr("default-src 'none'; script-src 'self'"));
  EXPECT_THAT(page.head, HasSubstr("frame-ancestors 'none'"));
  EXPECT_THAT(page.body, Not(HasSubstr("rig.toml")));
  EXPECT_THAT(page.body, Not(HasSubstr(token_)));
  EXPECT_EQ(Ask("GET", "/a/app.js").status, 200);
  EXPECT_EQ(Ask("GET", "/a/../api.js").status, 404);
  EXPECT_EQ(std::filesystem::status(base_ / "address").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST_F(Serve, RefusesOtherPagesAndUsers) {
  const std::string host = "127.0.0.1:" + std::to_string(port_);
  const auto status = [&](const std::string& text) { return Parsed(Raw(text)).status; };
  EXPECT_EQ(status(With(host, Token())), 200);
  EXPECT_EQ(status(With(host, "")), 403);
  EXPECT_EQ(status(With("evil.com", Token())), 403);
  EXPECT_EQ(status(With(host, Token() + "Origin: http://evil.com\r\n")), 403);
  EXPECT_EQ(status(With(host, Token() + "Sec-Fetch-Site: cross-site\r\n")), 403);
  EXPECT_EQ(status(With(host, Token() + "Host: evil.com\r\n")), 403);  // two hosts
  EXPECT_THAT(Raw(With(host, Token() + "Origin: http://" + host + "\r\n")),
              Not(HasSubstr("Access-Control")));
  for (const char* method : {"POST", "PUT", "DELETE"})
    EXPECT_EQ(status(std::string(method) + " /api/jobs HTTP/1.1\r\nHost: " + host +
                     "\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"),
              403)
        << method;
}

TEST_F(Serve, PathTricksShowNothingOutside) {
  for (const char* path :
       {"../other/secret.toml", "%2e%2e/other/secret.toml", "sub/../../other/secret.toml",
        "..%2fother%2fsecret.toml", "/etc/passwd", "%2fetc%2fpasswd", "a.toml%00.csv",
        ".ambrig/server", "....//other/secret.toml", "sub"}) {
    const Answer a = Ask("GET", std::string("/api/file?p=") + path);
    EXPECT_EQ(a.status, 400) << path;
    EXPECT_THAT(a.body, Not(HasSubstr("secret =")));
    EXPECT_EQ(Ask("PUT", std::string("/api/upload?p=") + path, "x").status, 400) << path;
  }
  EXPECT_EQ(Text("other/secret.toml"), "secret = 1\n");
}

TEST_F(Serve, FilesAreWrittenAgainstTheirVersion) {
  const Answer read = Ask("GET", "/api/file?p=a.toml");
  EXPECT_EQ(read.body, "x = 1\n");
  const auto at = read.head.find("ETag: ");
  ASSERT_NE(at, std::string::npos);
  const std::string tag = read.head.substr(at + 6, 18);
  EXPECT_EQ(Ask("PUT", "/api/file?p=a.toml", "x = 2\n").status, 412);
  const Answer written = Ask("PUT", "/api/file?p=a.toml", "x = 2\n", "If-Match: " + tag + "\r\n");
  EXPECT_EQ(written.status, 200);
  EXPECT_EQ(Ask("PUT", "/api/file?p=a.toml", "x = 3\n", "If-Match: " + tag + "\r\n").status, 412);
  EXPECT_EQ(Text("served/a.toml"), "x = 2\n");
  EXPECT_EQ(Ask("POST", "/api/undo/" + written.Json()["step"].dump()).status, 200);
  EXPECT_EQ(Text("served/a.toml"), "x = 1\n");
  EXPECT_EQ(Ask("PUT", "/api/file?p=a.toml", std::string(2 << 20, 'x'), "If-Match: " + tag + "\r\n")
                .status,
            413);
  EXPECT_EQ(Ask("PUT", "/api/upload?p=log.csv", std::string(2 << 20, 'x')).status, 201);
  EXPECT_EQ(std::filesystem::file_size(base_ / "served" / "log.csv"), 2u << 20);
  EXPECT_EQ(Ask("PUT", "/api/upload?p=log.csv", "y").status, 400);  // never over another
}

TEST_F(Serve, AJobIsACommandWhoseResultIsItsFile) {
  const Answer started = Ask("POST", "/api/jobs", R"({"command":"run","scenario":"short.toml"})");
  ASSERT_EQ(started.status, 202) << started.body;
  const nlohmann::json job = Ended(started.Json()["id"]);
  EXPECT_EQ(job["state"], "done") << job;
  nlohmann::json found = Ask("GET", "/api/result?kind=run&p=short.toml").Json();
  EXPECT_EQ(found["fresh"], true) << found;
  EXPECT_EQ(found["result"]["name"], "short");
  const nlohmann::json series =
      Ask("GET", "/api/series?job=" + job["id"].dump() + "&run=short.h5").Json();
  EXPECT_EQ(series["rate"], 12500.0) << series;
  const std::string bytes =
      Ask("GET", "/api/series?job=" + job["id"].dump() + "&run=short.h5&c=A.x,A.i3&px=50").body;
  EXPECT_THAT(bytes, HasSubstr("\"mode\":\"extremes\""));
  std::uint32_t head = 0;
  std::memcpy(&head, bytes.data(), sizeof head);
  EXPECT_EQ(bytes.size(), 4 + head + 2 * 2 * 50 * sizeof(float));
  // The rig changes: the result is no longer that of the files.
  std::ofstream(base_ / "served" / "rig.toml", std::ios::app) << "\n# changed\n";
  found = Ask("GET", "/api/result?kind=run&p=short.toml").Json();
  EXPECT_EQ(found["fresh"], false);
  EXPECT_EQ(found["stale"][0], "rig.toml");
}

TEST_F(Serve, ABrokenRecordEndsTheReaderOnly) {
  Write("served/broken.h5", std::string("\x89HDF\r\n\x1a\n") + std::string(500, '\xff'));
  Write("served/empty.h5", "");
  EXPECT_EQ(Ask("GET", "/api/series?p=broken.h5").status, 400);
  EXPECT_EQ(Ask("GET", "/api/series?p=empty.h5").status, 400);
  const nlohmann::json csv = Ask("GET", "/api/series?p=sub/b.csv").Json();
  EXPECT_EQ(csv["rows"], 2) << csv;
}

TEST_F(Serve, AWrongCommandFailsWithItsLine) {
  Write("served/bad.toml", "name = \"bad\"\nrig = \"rig.toml\"\nduration = -1\n");
  const Answer started = Ask("POST", "/api/jobs", R"({"command":"run","scenario":"bad.toml"})");
  const nlohmann::json job = Ended(started.Json()["id"]);
  EXPECT_EQ(job["state"], "failed");
  EXPECT_THAT(job["error"].get<std::string>(), HasSubstr("bad.toml:3: duration"));
}

// Whatever comes, the server answers the next request.
TEST_F(Serve, RandomRequestsLeaveItWell) {
  std::mt19937_64 random(11);
  const std::vector<std::string> parts = {"GET",
                                          "PUT",
                                          "POST",
                                          "DELETE",
                                          " ",
                                          "/",
                                          "/api/",
                                          "jobs",
                                          "file?p=",
                                          "series?c=",
                                          "&px=-1",
                                          "%",
                                          "%00",
                                          "..",
                                          "HTTP/1.1",
                                          "\r\n",
                                          "\r\n\r\n",
                                          "Host: ",
                                          "127.0.0.1",
                                          "Authorization: Bearer " + token_,
                                          "Content-Length: ",
                                          "99999999999999999999",
                                          "-1",
                                          "Transfer-Encoding: chunked",
                                          "{",
                                          "}",
                                          "\"command\":",
                                          "\x80\xff",
                                          ":",
                                          "0",
                                          "ffffffffffffffff\r\n",
                                          std::string("\0", 1),
                                          std::string(3000, 'a')};
  for (int k = 0; k < 10000; ++k) {
    std::string bytes = k % 2 == 0 ? Head("GET", "/api/") : "";
    if (k % 2 == 0) bytes.insert(random() % bytes.size(), parts[random() % parts.size()]);
    for (std::size_t n = random() % 12; n > 0; --n) bytes += parts[random() % parts.size()];
    Raw(bytes);
  }
  EXPECT_EQ(Ask("GET", "/api/folder").status, 200);
  EXPECT_EQ(Kill(SIGINT), 0);
}

// An endless header is cut, fifty pages that listen do not keep others from being answered.
TEST_F(Serve, SlowAndManyClients) {
  const Answer cut = Parsed(Raw("GET / HTTP/1.1\r\nHost: " + std::string(1 << 20, 'a')));
  EXPECT_TRUE(cut.status == 0 || cut.status >= 400) << cut.status;
  std::vector<int> listeners;
  for (int k = 0; k < 50; ++k) {
    const int s = Connect();
    ASSERT_GE(s, 0);
    const std::string head = Head("GET", "/api/events");
    ::send(s, head.data(), head.size(), MSG_NOSIGNAL);
    listeners.push_back(s);
  }
  const int slow = Connect();
  ::send(slow, "GET / HT", 8, MSG_NOSIGNAL);
  std::atomic<int> answered{0};
  std::vector<std::thread> askers;
  for (int k = 0; k < 10; ++k)
    askers.emplace_back([&] {
      for (int n = 0; n < 10; ++n) answered += Ask("GET", "/api/jobs").status == 200;
    });
  for (std::thread& t : askers) t.join();
  EXPECT_EQ(answered, 100);
  char text[4096];
  const ssize_t n = ::recv(listeners[0], text, sizeof text, 0);
  EXPECT_THAT(std::string(text, static_cast<std::size_t>(std::max<ssize_t>(n, 0))),
              HasSubstr("200 OK"));
  for (const int s : listeners) ::close(s);
  ::close(slow);
  EXPECT_EQ(Kill(SIGINT), 0);
}

TEST_F(Serve, OneServerAFolder) {
  EXPECT_EQ(std::system((AMBRIG_BINARY " serve " + served() + " >/dev/null 2>&1").c_str()) >> 8, 2);
}

// After kill -9 the next server knows what was done, and a job that was cut off says so.
TEST_F(Serve, AKilledServerLosesNothing) {
  const int done =
      Ask("POST", "/api/jobs", R"({"command":"run","scenario":"short.toml"})").Json()["id"];
  EXPECT_EQ(Ended(done)["state"], "done");
  Write("served/long.toml",
        "name = \"long\"\nrig = \"rig.toml\"\nduration = 60\nrecord_rate = 1000.0\n");
  const int cut =
      Ask("POST", "/api/jobs", R"({"command":"run","scenario":"long.toml"})").Json()["id"];
  std::string state;
  for (int k = 0; k < 100 && state != "running"; ++k) {
    state = Ask("GET", "/api/jobs/" + std::to_string(cut)).Json()["state"];
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const int step = Ask("PUT", "/api/file?p=new.toml", "y = 1\n").Json()["step"];
  EXPECT_EQ(Kill(SIGKILL), 128 + SIGKILL);
  ServedBench::Serve();
  EXPECT_EQ(Ask("GET", "/api/jobs/" + std::to_string(done)).Json()["state"], "done");
  EXPECT_EQ(Ask("GET", "/api/jobs/" + std::to_string(cut)).Json()["state"], "interrupted");
  EXPECT_EQ(Ask("GET", "/api/result?kind=run&p=short.toml").Json()["fresh"], true);
  EXPECT_EQ(Ask("POST", "/api/undo/" + std::to_string(step)).status, 200);
  EXPECT_FALSE(std::filesystem::exists(base_ / "served" / "new.toml"));
  // The old token is worth nothing, new jobs do not overwrite old ones.
  const int next =
      Ask("POST", "/api/jobs", R"({"command":"run","scenario":"short.toml"})").Json()["id"];
  EXPECT_GT(next, cut);
  EXPECT_EQ(Ended(next)["state"], "done");
}

}  // namespace
}  // namespace ambrig::workbench
