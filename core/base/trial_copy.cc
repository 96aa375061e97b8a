#include "core/base/trial_copy.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace ambrig {
namespace {

constexpr rlim_t kMostSeconds = 60;  // of computing: HDF5 reads some gigabytes in that time

[[noreturn]] void WorkAndEnd(const std::function<void()>& work) {
  const rlimit none = {};
  setrlimit(RLIMIT_CORE, &none);
  const rlimit most = {kMostSeconds, kMostSeconds};
  setrlimit(RLIMIT_CPU, &most);
  std::signal(SIGINT, SIG_DFL);  // here Ctrl-C ends what does not end by itself
  std::signal(SIGTERM, SIG_DFL);
  // What a library or a sanitizer says of a damaged file is no word of this program.
  if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
  try {
    work();
  } catch (...) {
    // The call in the process itself says it.
  }
  _exit(0);
}

}  // namespace

bool SurvivesInACopy(const std::function<void()>& work) {
  const pid_t copy = fork();
  if (copy < 0) return true;  // no process to be had: then without the trial
  if (copy == 0) WorkAndEnd(work);
  int status = 0;
  while (waitpid(copy, &status, 0) < 0 && errno == EINTR) {
  }
  return status == 0;
}

}  // namespace ambrig
