// Who is refused: other hosts (DNS rebinding), other pages, nobody's and another session's token.
#include "workbench/request_guard.h"

#include <gtest/gtest.h>

#include <set>

namespace ambrig::workbench {
namespace {

const std::string kToken(64, 'a');

HttpRequest Asked(const std::map<std::string, std::string>& changes) {
  HttpRequest r{"GET", "/api/folder", {}, {}, "", ""};
  r.headers = {{"host", "127.0.0.1:8080"}, {"authorization", "Bearer " + kToken}};
  for (const auto& [name, value] : changes) {
    if (value.empty())
      r.headers.erase(name);
    else
      r.headers[name] = value;
  }
  return r;
}

bool Allowed(const std::map<std::string, std::string>& changes, bool open = false) {
  return RequestGuard(kToken).Complaint(Asked(changes), open).empty();
}

TEST(RequestGuard, TakesThePageOfThisServer) {
  EXPECT_TRUE(Allowed({}));
  EXPECT_TRUE(Allowed({{"host", "localhost:1"}}));
  EXPECT_TRUE(Allowed({{"host", "[::1]:65535"}}));
  EXPECT_TRUE(Allowed({{"host", "127.0.0.1"}}));
  EXPECT_TRUE(Allowed({{"origin", "http://127.0.0.1:8080"}, {"sec-fetch-site", "same-origin"}}));
  EXPECT_TRUE(Allowed({{"sec-fetch-site", "none"}}));
}

TEST(RequestGuard, RefusesOtherHosts) {
  for (const char* host : {"evil.com", "127.0.0.1.evil.com", "localhost.evil.com", "evil.com:8080",
                           "127.0.0.1:80:80", "127.0.0.1:", "127.0.0.1:8x", "[::1", "[::1]x",
                           "0.0.0.0", "127.0.0.1@evil.com", "2130706433", "\x01twice"})
    EXPECT_FALSE(Allowed({{"host", host}})) << host;
  EXPECT_FALSE(Allowed({{"host", ""}}));
  EXPECT_FALSE(Allowed({{"host", "evil.com"}}, true));  // the page itself too
}

TEST(RequestGuard, RefusesOtherPages) {
  for (const char* origin : {"http://evil.com", "null", "https://127.0.0.1:8080",
                             "http://127.0.0.1:8081", "http://localhost:8080"})
    EXPECT_FALSE(Allowed({{"origin", origin}})) << origin;
  for (const char* site : {"cross-site", "same-site", "anything"})
    EXPECT_FALSE(Allowed({{"sec-fetch-site", site}})) << site;
}

TEST(RequestGuard, WantsItsToken) {
  for (const std::string& token :
       {std::string(), std::string("Bearer "), "Bearer " + std::string(64, 'b'),
        "Bearer " + kToken + "a", "Bearer " + kToken.substr(1), kToken, "Basic " + kToken})
    EXPECT_FALSE(Allowed({{"authorization", token}})) << token;
  EXPECT_TRUE(Allowed({{"authorization", ""}}, true));  // the page holds nothing
  // A link on another page may open ours, but not frame it or load its scripts.
  EXPECT_TRUE(Allowed({{"sec-fetch-site", "cross-site"}, {"sec-fetch-mode", "navigate"}}, true));
  EXPECT_FALSE(Allowed({{"sec-fetch-site", "cross-site"}, {"sec-fetch-mode", "no-cors"}}, true));
}

TEST(RequestGuard, TokensAreNewEachTime) {
  std::set<std::string> tokens;
  for (int k = 0; k < 100; ++k) tokens.insert(MakeToken());
  EXPECT_EQ(tokens.size(), 100u);
  EXPECT_EQ(tokens.begin()->size(), 64u);
  EXPECT_TRUE(SameSecret("abc", "abc"));
  EXPECT_FALSE(SameSecret("abc", "abd"));
  EXPECT_FALSE(SameSecret("abc", ""));
  EXPECT_FALSE(SameSecret("", "abc"));
}

}  // namespace
}  // namespace ambrig::workbench
