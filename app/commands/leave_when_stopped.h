#pragma once
/// Ctrl-C within a second also in the middle of one long computation that cannot look at
/// `interrupted` itself: the eigenvalues of a large matrix, for one. Only around work that writes
/// nothing, for the process then ends where it is.
#include <condition_variable>
#include <mutex>
#include <thread>

namespace ambrig {

class LeaveWhenStopped {
 public:
  LeaveWhenStopped();
  ~LeaveWhenStopped();
  LeaveWhenStopped(const LeaveWhenStopped&) = delete;
  LeaveWhenStopped& operator=(const LeaveWhenStopped&) = delete;

 private:
  void Watch();

  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::thread watcher_;  // last: it reads the others
};

}  // namespace ambrig
