#include "control/external/controller_link.h"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "control/external/host/wire.h"
#include "control/external/host_image.h"

extern char** environ;

namespace ambrig {

namespace {

constexpr int kSocketOfTheHost = 3;

std::string EndedBySignal(int signal) {
  switch (signal) {
    case SIGFPE:
      return "divided an integer by zero (SIGFPE)";
    case SIGSEGV:
    case SIGBUS:
      return fmt::format("crashed: it touched memory that is not its own ({})",
                         signal == SIGBUS ? "SIGBUS" : "SIGSEGV");
    case SIGABRT:
      return "aborted: an exception that it did not catch, or a failed assertion (SIGABRT)";
    case SIGILL:
      return "crashed: an instruction that this processor does not have (SIGILL)";
    case SIGKILL:
      return "was killed from outside, or for want of memory (SIGKILL)";
    default:
      return fmt::format("was ended by signal {}", signal);
  }
}

void SetTimeout(int socket, double seconds) {
  timeval t{};
  t.tv_sec = static_cast<time_t>(seconds);
  t.tv_usec = static_cast<suseconds_t>((seconds - std::floor(seconds)) * 1e6);
  setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &t, sizeof t);
  setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &t, sizeof t);
}

/// In a process group of its own, so that Ctrl-C in the terminal reaches ambrig alone.
int SpawnHost(const std::string& library, int socket, pid_t* child) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, socket, kSocketOfTheHost);
  posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);  // stdout is ambrig's
  posix_spawnattr_t how;
  posix_spawnattr_init(&how);
  posix_spawnattr_setflags(&how,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&how, &none);
  posix_spawnattr_setsigdefault(&how, &all);
  char name[] = "ambrig_controller_host";
  std::string path = library;
  char* arguments[] = {name, path.data(), nullptr};
  const int error =
      posix_spawn(child, ControllerHostPath().c_str(), &files, &how, arguments, environ);
  posix_spawnattr_destroy(&how);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

int ConnectUnix(const std::string& path) {
  sockaddr_un a{};
  a.sun_family = AF_UNIX;
  if (path.size() >= sizeof a.sun_path) {
    errno = ENAMETOOLONG;
    return -1;
  }
  std::memcpy(a.sun_path, path.c_str(), path.size() + 1);
  const int s = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (s < 0) return -1;
  if (connect(s, reinterpret_cast<const sockaddr*>(&a), sizeof a) == 0) return s;
  const int why = errno;
  close(s);
  errno = why;
  return -1;
}

int ConnectTcp(const std::string& host, const std::string& port) {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_socktype = SOCK_STREAM;
  if (const int error = getaddrinfo(host.c_str(), port.c_str(), &wanted, &found); error != 0)
    throw ControllerFailure(fmt::format("cannot be reached: {}", gai_strerror(error)));
  int s = -1, why = ECONNREFUSED;
  for (const addrinfo* a = found; a && s < 0; a = a->ai_next) {
    s = socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
    if (s >= 0 && connect(s, a->ai_addr, a->ai_addrlen) != 0) {
      why = errno;
      close(s);
      s = -1;
    }
  }
  freeaddrinfo(found);
  const int on = 1;
  if (s >= 0) setsockopt(s, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  errno = why;
  return s;
}

}  // namespace

ControllerLink::ControllerLink(int socket, pid_t child, double timeout)
    : socket_(socket), child_(child), timeout_(timeout) {
  SetTimeout(socket, timeout);
}

ControllerLink::ControllerLink(ControllerLink&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)),
      child_(std::exchange(other.child_, 0)),
      timeout_(other.timeout_) {}

ControllerLink ControllerLink::Start(const std::string& library, double timeout) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw ControllerFailure(fmt::format("cannot be started: {}", std::strerror(errno)));
  pid_t child = 0;
  const int error = SpawnHost(library, ends[1], &child);
  close(ends[1]);
  if (error != 0) {
    close(ends[0]);
    throw ControllerFailure(fmt::format("cannot be started: {}", std::strerror(error)));
  }
  return ControllerLink(ends[0], child, timeout);
}

ControllerLink ControllerLink::Connect(const std::string& address, double timeout) {
  int s = -1;
  if (address.starts_with("unix:")) {
    s = ConnectUnix(address.substr(5));
  } else {
    const std::size_t colon = address.rfind(':');
    s = ConnectTcp(address.substr(4, colon - 4), address.substr(colon + 1));
  }
  if (s < 0) throw ControllerFailure(fmt::format("cannot be reached: {}", std::strerror(errno)));
  return ControllerLink(s, 0, timeout);
}

ControllerLink::~ControllerLink() {
  if (socket_ >= 0) close(socket_);
  if (child_ <= 0 || Reap(0.5)) return;
  kill(child_, SIGKILL);
  Reap(5);
}

bool ControllerLink::Reap(double seconds) {
  for (double waited = 0, pause = 1e-4; child_ > 0; pause *= 2) {
    const pid_t r = waitpid(child_, &status_, WNOHANG);
    if (r != 0) {
      if (r < 0) status_ = 0;  // somebody else waits for all children of this program
      child_ = 0;
      return true;
    }
    if (waited >= seconds) return false;
    usleep(static_cast<useconds_t>(pause * 1e6));
    waited += pause;
  }
  return true;
}

void ControllerLink::TellEnd() {
  if (child_ <= 0) throw ControllerFailure("ended the connection");
  if (!Reap(timeout_)) TellTimeout();
  if (WIFSIGNALED(status_)) throw ControllerFailure(EndedBySignal(WTERMSIG(status_)));
  throw ControllerFailure(
      fmt::format("ended its own process with exit code {}", WEXITSTATUS(status_)));
}

void ControllerLink::TellTimeout() {
  if (child_ > 0) {
    kill(child_, SIGKILL);
    Reap(5);
  }
  throw ControllerFailure(
      fmt::format("did not answer within {} s, an endless loop? (key timeout)", timeout_));
}

/// A side that has ended may have said why before: whether it has is left to Receive.
void ControllerLink::Send(std::span<const unsigned char> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) TellTimeout();
    if (n <= 0) return;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void ControllerLink::Receive(std::span<unsigned char> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = recv(socket_, bytes.data(), bytes.size(), 0);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) TellTimeout();
    if (n <= 0) TellEnd();
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

ControllerLink::Answer ControllerLink::Ask(std::uint32_t kind,
                                           std::span<const unsigned char> payload) {
  const wire_header ask{kind, static_cast<std::uint32_t>(payload.size())};
  frame_.resize(sizeof ask + payload.size());
  std::memcpy(frame_.data(), &ask, sizeof ask);
  std::memcpy(frame_.data() + sizeof ask, payload.data(), payload.size());
  Send(frame_);
  wire_header head{};
  Receive({reinterpret_cast<unsigned char*>(&head), sizeof head});
  if (head.bytes > WIRE_MOST_BYTES || head.kind < WIRE_FORCE || head.kind > WIRE_FAILED)
    throw ControllerFailure("answered with something that is no message of ambrig's protocol");
  payload_.resize(head.bytes);
  Receive(payload_);
  if (head.kind == WIRE_FAILED)
    throw ControllerFailure(std::string(payload_.begin(), payload_.end()));
  return {head.kind, payload_};
}

}  // namespace ambrig
