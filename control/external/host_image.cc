#include "control/external/host_image.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "control/external/controller_link.h"

extern "C" {
// cmake/controller_host.cmake
extern const char ambrig_controller_host_begin[], ambrig_controller_host_end[];
extern const char ambrig_controller_header_begin[], ambrig_controller_header_end[];
}

namespace ambrig {

namespace {

/// In memory: nothing is left in a temporary folder, whatever happens to this process.
std::string WriteImage() {
  const int file = memfd_create("ambrig_controller_host", MFD_CLOEXEC);
  if (file < 0) throw ControllerFailure(std::string("cannot be started: ") + std::strerror(errno));
  const char* from = ambrig_controller_host_begin;
  while (from < ambrig_controller_host_end) {
    const ssize_t n =
        write(file, from, static_cast<std::size_t>(ambrig_controller_host_end - from));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const std::string why = std::strerror(errno);
      close(file);
      throw ControllerFailure("cannot be started: " + why);
    }
    from += n;
  }
  return "/proc/self/fd/" + std::to_string(file);
}

}  // namespace

const std::string& ControllerHostPath() {
  static const std::string path = WriteImage();
  return path;
}

std::string ControllerHeader() {
  return {ambrig_controller_header_begin, ambrig_controller_header_end};
}

}  // namespace ambrig
