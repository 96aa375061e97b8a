#pragma once
/// The one folder that is served: every name is relative, opened beneath it by the kernel
/// (openat2), never through a link, and is a regular file of a known kind.
#include <cstdint>
#include <string>
#include <vector>

namespace ambrig::workbench {

/// A file as the folder lists it.
struct ServedFile {
  std::string name;        // relative, "practice/case.toml"
  std::uint64_t size = 0;  // [bytes]
  double changed = 0;      // [s] since 1970
};

class ServedFolder {
 public:
  /// @throws InputError when it is no folder
  explicit ServedFolder(const std::string& path);
  ~ServedFolder();
  ServedFolder(const ServedFolder&) = delete;
  ServedFolder& operator=(const ServedFolder&) = delete;

  const std::string& path() const { return path_; }
  int descriptor() const { return folder_; }

  /// A descriptor that the caller closes. @throws InputError for a name that is not allowed, is not
  /// there, leaves the folder or is no regular file
  int OpenToRead(const std::string& name) const;
  /// @throws InputError, also when it is larger than `limit`
  std::string Read(const std::string& name, std::size_t limit) const;
  bool Has(const std::string& name) const;
  /// Whether a folder of this name lies in it, reached without a link.
  bool HasFolder(const std::string& name) const;
  /// The whole file or none of it: temporary name, then renamed within its folder, which exists.
  /// @throws InputError
  void Write(const std::string& name, const std::string& text) const;
  /// Gives a finished file of any place on the same disk its name; never over another.
  /// @throws InputError
  void MoveIn(const std::string& file, const std::string& name) const;
  void Remove(const std::string& name) const;
  /// Moves a file of the folder to any place on the same disk. @throws InputError
  void MoveOut(const std::string& name, const std::string& file) const;
  /// Size and time of the last change, as a text that another version does not have; "" when it is
  /// not there.
  std::string Version(const std::string& name) const;

  /// All files of known kinds, sorted, without hidden ones; at most `most`.
  std::vector<ServedFile> List(std::size_t most) const;

 private:
  int OpenParent(const std::string& name, std::string* leaf) const;

  std::string path_;
  int folder_ = -1;
};

/// Whether a relative name may be asked for: no "..", no hidden part, no control character, an
/// extension of what ambrig reads or writes.
bool IsServedName(const std::string& name);

}  // namespace ambrig::workbench
