#include "app/report/write_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/errors.h"

namespace ambrig {
namespace {

// 0, or the errno of what failed; a full disk may show only at fsync or close.
int WriteAll(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(file, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  // Pipes and some file systems cannot sync and need not.
  if (::fsync(file) != 0 && errno != EINVAL && errno != EROFS) return errno;
  return 0;
}

}  // namespace

void WriteFileAtomically(const std::filesystem::path& path, std::string_view text) {
  const auto fail = [&path](int reason) {
    throw InputError(path.string() + ": cannot be written: " + std::strerror(reason));
  };
  std::error_code folder;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), folder);
  if (folder) fail(folder.value());
  if (std::filesystem::is_directory(path, folder)) fail(EISDIR);
  const std::string temporary = path.string() + "." + std::to_string(::getpid()) + ".tmp";
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) fail(errno);
  int reason = WriteAll(file, text);
  if (::close(file) != 0 && reason == 0) reason = errno;
  if (reason == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) reason = errno;
  if (reason == 0) return;
  ::unlink(temporary.c_str());
  fail(reason);
}

}  // namespace ambrig
