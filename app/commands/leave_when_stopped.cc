#include "app/commands/leave_when_stopped.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "app/commands/command.h"
#include "app/commands/event_stream.h"

namespace ambrig {

namespace {
constexpr auto kLook = std::chrono::milliseconds(50);
constexpr int kPatience = 10;  // looks: the work may end by itself, which is cleaner
}  // namespace

void TellInterrupted() {
  fmt::print(stderr, "ambrig: interrupted, nothing half-written is left\n");
  Events().Done(kInterruptedCode, "interrupted");
}

LeaveWhenStopped::LeaveWhenStopped() : watcher_([this] { Watch(); }) {}

LeaveWhenStopped::~LeaveWhenStopped() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  ended_.notify_all();
  watcher_.join();
}

void LeaveWhenStopped::Watch() {
  std::unique_lock lock(mutex_);
  for (int stopped = 0; stopped < kPatience; stopped += interrupted ? 1 : 0)
    if (ended_.wait_for(lock, kLook, [this] { return done_; })) return;
  TellInterrupted();
  // no destructors: threads of the computation still use what they would end
  std::_Exit(kInterruptedCode);
}

}  // namespace ambrig
