#pragma once
/// A stream socket to the process of a controller: whole messages with a time limit (host/wire.h).
/// The process is a child that the link starts with a shared library, or firmware that
/// listens at an address. Whatever it does, crash, hang or nonsense, ends in a ControllerFailure
/// with one sentence.
#include <sys/types.h>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace ambrig {

/// What a controller did instead of its work: "did not answer within 5 s".
class ControllerFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ControllerLink {
 public:
  /// A process of its own that loads `library` (a path). `timeout`: of every answer [s].
  static ControllerLink Start(const std::string& library, double timeout);
  /// `address`: unix:PATH or tcp:HOST:PORT.
  static ControllerLink Connect(const std::string& address, double timeout);
  ControllerLink(ControllerLink&& other) noexcept;
  ControllerLink& operator=(ControllerLink&&) = delete;
  ~ControllerLink();

  struct Answer {
    std::uint32_t kind = 0;
    std::span<const unsigned char> payload;  // until the next question
  };
  /// One message and the answer to it. @throws ControllerFailure
  Answer Ask(std::uint32_t kind, std::span<const unsigned char> payload);

 private:
  ControllerLink(int socket, pid_t child, double timeout);
  void Send(std::span<const unsigned char> bytes);
  void Receive(std::span<unsigned char> bytes);
  /// The connection ended: how the process did. @throws ControllerFailure
  [[noreturn]] void TellEnd();
  [[noreturn]] void TellTimeout();
  /// Waits up to `seconds` for the child's end. @return whether it ended; its status in status_.
  bool Reap(double seconds);

  int socket_;
  pid_t child_;  // 0: not ours
  double timeout_;
  int status_ = 0;
  std::vector<unsigned char> frame_, payload_;
};

}  // namespace ambrig
