#pragma once
/// A server of its own and raw requests to it, so that a test may say anything a browser would not.
#include <arpa/inet.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/workbench/bench_folder.h"

extern char** environ;

namespace ambrig::workbench {

struct Answer {
  int status = 0;  // 0: none
  std::string head, body;
  nlohmann::json Json() const { return nlohmann::json::parse(body, nullptr, false); }
};

class ServedBench : public BenchFolder {
 protected:
  void TearDown() override {
    Kill(SIGKILL);
    BenchFolder::TearDown();
  }

  /// Starts `ambrig serve` on the folder and reads its address. The shell gives way to the program,
  /// after `before` ("ulimit -f 64; ").
  void Serve(const std::string& before = "") {
    const std::string file = (base_ / "address").string();
    std::filesystem::remove(file);
    const std::string line = before + "exec " AMBRIG_BINARY " serve " + served() +
                             " --address-file " + file + " > " + (base_ / "log").string() + " 2>&1";
    const char* argv[] = {"sh", "-c", line.c_str(), nullptr};
    ASSERT_EQ(
        ::posix_spawn(&server_, "/bin/sh", nullptr, nullptr, const_cast<char**>(argv), environ), 0);
    for (int k = 0; k < 600 && !std::filesystem::exists(file); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const std::string address = Text("address");
    const auto colon = address.find(':', 6), hash = address.find("/#token=");
    ASSERT_NE(hash, std::string::npos) << Text("log");
    port_ = static_cast<std::uint16_t>(std::stoi(address.substr(colon + 1, hash - colon - 1)));
    token_ = address.substr(hash + 8, 64);
  }
  /// @return exit code, 128 + signal when one ended it
  int Kill(int signal) {
    if (server_ <= 0) return -1;
    ::kill(server_, signal);
    int status = 0;
    ::waitpid(server_, &status, 0);
    server_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  int Connect() const {
    const int s = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port_);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{60, 0};
    ::setsockopt(s, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (::connect(s, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) return s;
    ::close(s);
    return -1;
  }
  /// These very bytes, and what comes back until the server closes.
  std::string Raw(const std::string& bytes) const {
    const int s = Connect();
    if (s < 0) return "";
    ::send(s, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    ::shutdown(s, SHUT_WR);
    std::string out;
    char block[1 << 14];
    for (ssize_t n; (n = ::recv(s, block, sizeof block, 0)) > 0;)
      out.append(block, static_cast<std::size_t>(n));
    ::close(s);
    return out;
  }
  std::string Head(const std::string& method, const std::string& path, const std::string& more = "",
                   std::size_t body = 0) const {
    return method + " " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) +
           "\r\nConnection: close\r\nAuthorization: Bearer " + token_ +
           "\r\nContent-Length: " + std::to_string(body) + "\r\n" + more + "\r\n";
  }
  Answer Ask(const std::string& method, const std::string& path, const std::string& body = "",
             const std::string& more = "") const {
    return Parsed(Raw(Head(method, path, more, body.size()) + body));
  }
  static Answer Parsed(const std::string& text) {
    const auto end = text.find("\r\n\r\n");
    if (!text.starts_with("HTTP/1.1 ") || end == std::string::npos) return {};
    return {std::stoi(text.substr(9, 3)), text.substr(0, end), text.substr(end + 4)};
  }
  /// The job's state once it has ended.
  nlohmann::json Ended(int id) const {
    for (int k = 0; k < 3000; ++k) {
      const nlohmann::json state = Ask("GET", "/api/jobs/" + std::to_string(id)).Json();
      if (state.value("state", "") != "queued" && state.value("state", "") != "running")
        return state;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return {};
  }

  int server_ = 0;
  std::uint16_t port_ = 0;
  std::string token_;
};

}  // namespace ambrig::workbench
