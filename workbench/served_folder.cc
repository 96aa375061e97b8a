#include "workbench/served_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/base/errors.h"

namespace ambrig::workbench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtensions[] = {".toml", ".csv", ".h5",   ".hdf5", ".mat", ".json", ".txt",
                                       ".uff",  ".unv", ".tdms", ".html", ".svg", ".md",   ".dat"};

int OpenBeneath(int folder, const std::string& name, std::uint64_t flags, std::uint64_t mode = 0) {
  open_how how{};
  how.flags = flags | O_CLOEXEC | O_NONBLOCK;
  how.mode = mode;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS;
  return static_cast<int>(::syscall(SYS_openat2, folder, name.c_str(), &how, sizeof how));
}

[[noreturn]] void Refuse(const std::string& name, const std::string& why) {
  throw InputError(fmt::format("{}: {}", name, why));
}

std::string WhyNotOpened(int error) {
  if (error == ELOOP) return "is a link, allowed: files of the served folder itself";
  if (error == EXDEV) return "lies outside the served folder";
  return std::strerror(error);
}

void WriteAll(int file, std::string_view text, const std::string& name) {
  while (!text.empty()) {
    const ssize_t n = ::write(file, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) Refuse(name, fmt::format("cannot be written: {}", std::strerror(errno)));
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

}  // namespace

bool IsServedName(const std::string& name) {
  if (name.empty() || name.size() > 1024 || name.front() == '/' || name.front() == '-')
    return false;
  if (std::any_of(name.begin(), name.end(),
                  [](unsigned char c) { return c < 0x20 || c == 0x7f || c == '\\'; }))
    return false;
  for (const fs::path& part : fs::path(name))
    if (part.empty() || part.string().front() == '.') return false;
  std::string extension = fs::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(std::begin(kExtensions), std::end(kExtensions), extension) !=
         std::end(kExtensions);
}

ServedFolder::ServedFolder(const std::string& path) {
  std::error_code error;
  path_ = fs::canonical(path, error).string();
  if (error || !fs::is_directory(path_, error))
    throw InputError(path + ": is no folder, allowed: the folder to work in");
  folder_ = ::open(path_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (folder_ < 0) throw InputError(fmt::format("{}: {}", path, std::strerror(errno)));
}

ServedFolder::~ServedFolder() { ::close(folder_); }

int ServedFolder::OpenToRead(const std::string& name) const {
  if (!IsServedName(name)) Refuse(name, "is not a name of this folder");
  const int file = OpenBeneath(folder_, name, O_RDONLY);
  if (file < 0) Refuse(name, WhyNotOpened(errno));
  struct stat status {};
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(file);
    Refuse(name, "is no regular file");
  }
  return file;
}

std::string ServedFolder::Read(const std::string& name, std::size_t limit) const {
  const int file = OpenToRead(name);
  std::string text;
  char block[1 << 16];
  ssize_t n = 0;
  while ((n = ::read(file, block, sizeof block)) > 0 && text.size() <= limit)
    text.append(block, static_cast<std::size_t>(n));
  ::close(file);
  if (n < 0) Refuse(name, "cannot be read");
  if (text.size() > limit) Refuse(name, "is too large to be shown");
  return text;
}

bool ServedFolder::Has(const std::string& name) const {
  try {
    ::close(OpenToRead(name));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

bool ServedFolder::HasFolder(const std::string& name) const {
  if (!IsServedName(name + "/x.toml")) return false;
  const int folder = OpenBeneath(folder_, name, O_RDONLY | O_DIRECTORY);
  if (folder >= 0) ::close(folder);
  return folder >= 0;
}

int ServedFolder::OpenParent(const std::string& name, std::string* leaf) const {
  if (!IsServedName(name)) Refuse(name, "is not a name of this folder");
  const std::string parent = fs::path(name).parent_path().string();
  *leaf = fs::path(name).filename().string();
  const int folder = OpenBeneath(folder_, parent.empty() ? "." : parent, O_RDONLY | O_DIRECTORY);
  if (folder < 0) Refuse(name, WhyNotOpened(errno));
  return folder;
}

void ServedFolder::Write(const std::string& name, const std::string& text) const {
  static std::atomic<unsigned> count{0};
  std::string leaf;
  const int folder = OpenParent(name, &leaf);
  const std::string temporary = fmt::format(".{}.{}.{}.tmp", leaf, ::getpid(), ++count);
  const int file = ::openat(folder, temporary.c_str(),
                            O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
  std::string problem;
  if (file < 0) problem = std::strerror(errno);
  try {
    if (file >= 0) WriteAll(file, text, name);
  } catch (const InputError& e) {
    problem = e.what();
  }
  if (file >= 0 && ::fsync(file) != 0 && problem.empty()) problem = std::strerror(errno);
  if (file >= 0) ::close(file);
  if (problem.empty() && ::renameat(folder, temporary.c_str(), folder, leaf.c_str()) != 0)
    problem = std::strerror(errno);
  if (!problem.empty() && file >= 0) ::unlinkat(folder, temporary.c_str(), 0);
  ::close(folder);
  if (!problem.empty()) Refuse(name, "cannot be written: " + problem);
}

void ServedFolder::MoveIn(const std::string& file, const std::string& name) const {
  std::string leaf;
  const int folder = OpenParent(name, &leaf);
  const bool moved =
      ::renameat2(AT_FDCWD, file.c_str(), folder, leaf.c_str(), RENAME_NOREPLACE) == 0;
  const int error = errno;
  ::close(folder);
  if (!moved)
    Refuse(name, error == EEXIST ? "exists, allowed: another name" : std::strerror(error));
}

void ServedFolder::Remove(const std::string& name) const {
  std::string leaf;
  const int folder = OpenParent(name, &leaf);
  ::unlinkat(folder, leaf.c_str(), 0);
  ::close(folder);
}

void ServedFolder::MoveOut(const std::string& name, const std::string& file) const {
  std::string leaf;
  const int folder = OpenParent(name, &leaf);
  const bool moved = ::renameat(folder, leaf.c_str(), AT_FDCWD, file.c_str()) == 0;
  const int error = errno;
  ::close(folder);
  if (!moved) Refuse(name, std::strerror(error));
}

std::string ServedFolder::Version(const std::string& name) const {
  try {
    const int file = OpenToRead(name);
    struct stat status {};
    const bool known = ::fstat(file, &status) == 0;
    ::close(file);
    if (!known) return "";
    return fmt::format("{}|{}|{}.{}", status.st_ino, status.st_size, status.st_mtim.tv_sec,
                       status.st_mtim.tv_nsec);
  } catch (const InputError&) {
    return "";
  }
}

std::vector<ServedFile> ServedFolder::List(std::size_t most) const {
  std::vector<ServedFile> files;
  std::error_code error;
  fs::recursive_directory_iterator entry(path_, fs::directory_options::skip_permission_denied,
                                         error),
      end;
  for (; !error && entry != end && files.size() < most; entry.increment(error)) {
    const std::string leaf = entry->path().filename().string();
    std::error_code ignored;
    const bool hidden = leaf.starts_with('.');
    if (entry->is_directory(ignored)) {
      if (hidden || entry->is_symlink(ignored)) entry.disable_recursion_pending();
      continue;
    }
    struct stat status {};
    if (hidden || ::lstat(entry->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode))
      continue;
    const std::string name = entry->path().lexically_relative(path_).string();
    if (!IsServedName(name)) continue;
    files.push_back({name, static_cast<std::uint64_t>(status.st_size),
                     static_cast<double>(status.st_mtim.tv_sec) +
                         1e-9 * static_cast<double>(status.st_mtim.tv_nsec)});
  }
  std::sort(files.begin(), files.end(),
            [](const ServedFile& a, const ServedFile& b) { return a.name < b.name; });
  return files;
}

}  // namespace ambrig::workbench
