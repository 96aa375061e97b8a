#pragma once
/// A file that only grows (journals): what was appended is in the system's hands when Append
/// returns, so that kill -9 loses none of it. One process at a time.
#include <cstddef>
#include <string>
#include <string_view>

namespace ambrig {

class AppendFile {
 public:
  /// Begins the file (and its folder) or goes on with the one that is there.
  /// @throws InputError when it cannot be written or another process has it.
  explicit AppendFile(const std::string& path);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  const std::string& path() const { return path_; }
  /// @throws InputError (full disk ...); then every later one too and with the same reason, as the
  /// last entry may be half and the thread that reports first must name the cause.
  void Append(std::string_view bytes);
  /// Cuts the file to `size` bytes. @throws InputError
  void Truncate(std::size_t size);
  /// Fills `out` with the bytes from `offset`; false when they are not there. Thread-safe.
  bool ReadAt(std::size_t offset, char* out, std::size_t size) const;

 private:
  std::string path_;
  int file_ = -1;
  int error_ = 0;  // errno of the first entry that failed
};

}  // namespace ambrig
