#include "core/base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "core/base/errors.h"

namespace ambrig {
namespace {

/// Closes what it opened; the reason of a failure is in errno.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags)
      : fd_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool usable() const { return fd_ >= 0; }
  int get() const { return fd_; }
  /// False when the file system reports a late write error.
  bool Close() {
    const int fd = fd_;
    fd_ = -1;
    return close(fd) == 0;
  }

 private:
  int fd_;
};

bool WriteAll(int fd, std::string_view content) {
  while (!content.empty()) {
    const ssize_t n = write(fd, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

bool IsNoFile(const std::string& path) {
  struct stat info = {};
  return stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

void WriteInPlace(const std::string& path, std::string_view content) {
  // Opening a pipe that nobody reads any more would wait for ever; writing waits for a slow reader.
  Descriptor file(path, O_WRONLY | O_NONBLOCK);
  if (!file.usable()) ThrowCannotWrite(path, errno == ENXIO ? EPIPE : errno);
  if (fcntl(file.get(), F_SETFL, O_WRONLY) != 0 || !WriteAll(file.get(), content))
    ThrowCannotWrite(path, errno);
}

std::string ResolveLinks(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
  return error ? path : target.string();
}

// Two threads may write the same name; the counter keeps their temporary files apart.
std::string TemporaryName(const std::string& target) {
  static std::atomic<unsigned> counter{0};
  return target + ".tmp." + std::to_string(getpid()) + '.' + std::to_string(counter++);
}

}  // namespace

bool IsWrittenInPlace(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_character_file(path, error) || std::filesystem::is_fifo(path, error);
}

void ThrowCannotWrite(const std::string& path, int error_number) {
  throw InputError("cannot write " + path + ": " + std::generic_category().message(error_number));
}

AtomicFile::AtomicFile(const std::string& path)
    : path_(path), target_(ResolveLinks(path)), temporary_(TemporaryName(target_)) {
  // Renaming over a device or a folder would replace the device, or fail only after all the work.
  std::error_code ignored;  // what cannot be looked at cannot be created either
  if (std::filesystem::is_directory(target_, ignored)) ThrowCannotWrite(path_, EISDIR);
  if (IsNoFile(target_)) throw InputError("cannot write " + path_ + ": not a regular file");
  if (!Descriptor(temporary_, O_CREAT | O_EXCL | O_WRONLY).usable()) ThrowCannotWrite(path_, errno);
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void AtomicFile::Write(std::string_view content) {
  Descriptor file(temporary_, O_WRONLY | O_APPEND);
  if (!file.usable() || !WriteAll(file.get(), content) || !file.Close())
    ThrowCannotWrite(path_, errno);
}

void AtomicFile::Commit() {
  Descriptor file(temporary_, O_RDWR);
  if (!file.usable() || fsync(file.get()) != 0 || !file.Close()) ThrowCannotWrite(path_, errno);
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) ThrowCannotWrite(path_, errno);
  temporary_.clear();
}

void WriteFileAtomically(const std::string& path, std::string_view content) {
  if (IsWrittenInPlace(path)) {
    WriteInPlace(path, content);
    return;
  }
  AtomicFile file(path);
  file.Write(content);
  file.Commit();
}

}  // namespace ambrig
