/// The server's side of the reader process.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/errors.h"
#include "workbench/record_reader.h"

extern char** environ;

namespace ambrig::workbench {
namespace {

constexpr int kPatienceMs = 30000;
constexpr std::uint64_t kLargestAnswer = 64 << 20;  // [bytes]

/// False at the end, after an error or when nothing comes for long.
bool ReceiveExactly(int socket, char* out, std::size_t bytes) {
  while (bytes > 0) {
    pollfd wait{socket, POLLIN, 0};
    if (::poll(&wait, 1, kPatienceMs) <= 0) return false;
    const ssize_t n = ::recv(socket, out, bytes, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    out += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

RecordReader::~RecordReader() { EndReader(); }

void RecordReader::EndReader() {
  if (socket_ >= 0) ::close(socket_);
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  socket_ = -1;
  pid_ = 0;
}

void RecordReader::StartReader() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw InputError(fmt::format("no reader: {}", std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 3);
  const std::string arguments[] = {program_, "serve", "--reader", "3"};
  char* argv[] = {const_cast<char*>(arguments[0].c_str()), const_cast<char*>(arguments[1].c_str()),
                  const_cast<char*>(arguments[2].c_str()), const_cast<char*>(arguments[3].c_str()),
                  nullptr};
  pid_t pid = 0;
  const int error = ::posix_spawn(&pid, program_.c_str(), &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error != 0) {
    ::close(ends[0]);
    throw InputError(fmt::format("no reader: {}", std::strerror(error)));
  }
  socket_ = ends[0];
  pid_ = pid;
}

bool RecordReader::Exchange(const std::string& line, std::string* answer) {
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t n = ::send(socket_, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  std::uint64_t bytes = 0;
  if (!ReceiveExactly(socket_, reinterpret_cast<char*>(&bytes), sizeof bytes)) return false;
  if (bytes == 0 || bytes > kLargestAnswer) return false;
  answer->resize(bytes);
  return ReceiveExactly(socket_, answer->data(), bytes);
}

std::string RecordReader::Ask(const nlohmann::ordered_json& request) {
  const std::scoped_lock lock(mutex_);
  if (socket_ < 0) StartReader();
  std::string answer;
  if (!Exchange(request.dump() + '\n', &answer)) {
    EndReader();
    throw InputError(
        fmt::format("{}: the reader of data files died of it or took too long; it is damaged, or "
                    "too large for 1 GiB of memory",
                    request.value("name", "")));
  }
  if (answer.starts_with("J{\"error\""))
    throw InputError(nlohmann::json::parse(answer.substr(1))["error"].get<std::string>());
  return answer;
}

}  // namespace ambrig::workbench
