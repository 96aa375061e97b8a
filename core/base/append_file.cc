#include "core/base/append_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "core/base/atomic_file.h"
#include "core/base/errors.h"

namespace ambrig {

AppendFile::AppendFile(const std::string& path) : path_(path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) ThrowCannotWrite(folder.string(), error.value());
  // What was written is read back: from a pipe that would last for ever.
  if (std::filesystem::is_fifo(path, error))
    throw InputError("cannot write " + path + ": not a regular file");
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0) ThrowCannotWrite(path_, errno);
  if (flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  close(file_);
  throw InputError(folder.string() +
                   ": another ambrig writes there; wait for it, or give another folder");
}

AppendFile::~AppendFile() { close(file_); }

void AppendFile::Append(std::string_view bytes) {
  if (error_ != 0) ThrowCannotWrite(path_, error_);
  while (!bytes.empty()) {
    const ssize_t n = write(file_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      error_ = errno;
      ThrowCannotWrite(path_, error_);
    }
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void AppendFile::Truncate(std::size_t size) {
  if (ftruncate(file_, static_cast<off_t>(size)) != 0) ThrowCannotWrite(path_, errno);
}

bool AppendFile::ReadAt(std::size_t offset, char* out, std::size_t size) const {
  while (size > 0) {
    const ssize_t n = pread(file_, out, size, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    out += n;
    offset += static_cast<std::size_t>(n);
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace ambrig
