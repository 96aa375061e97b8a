#pragma once
/// Output files appear complete or not at all: written under a temporary name in the same folder,
/// flushed to the disk, renamed. An error or an exception leaves the old file, if any, untouched.
#include <string>
#include <string_view>

namespace ambrig {

/// A temporary file beside `path` that becomes `path` at Commit() and is removed without it.
/// For libraries that want a file name; otherwise WriteFileAtomically.
class AtomicFile {
 public:
  /// Creates the empty temporary file; a link is followed, so that its target is replaced.
  /// @throws InputError "cannot write PATH: reason".
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& temporary() const { return temporary_; }
  /// @throws InputError
  void Write(std::string_view content);
  /// Flushes and renames. @throws InputError
  void Commit();

 private:
  std::string path_;       // as the user named it
  std::string target_;     // links resolved
  std::string temporary_;  // empty once committed
};

/// Whether the path is a character device or a pipe; sockets, which cannot be opened, and
/// disks are not.
bool IsWrittenInPlace(const std::string& path);

/// Replaces `path` by `content`. Character devices and pipes that somebody reads (/dev/stdout) are
/// written in place.
/// @throws InputError "cannot write PATH: reason".
void WriteFileAtomically(const std::string& path, std::string_view content);

/// "cannot write PATH: reason of the error number", thrown as InputError.
[[noreturn]] void ThrowCannotWrite(const std::string& path, int error_number);

}  // namespace ambrig
