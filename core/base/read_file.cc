#include "core/base/read_file.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/base/errors.h"

namespace ambrig {

bool IsNamedPipe(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_fifo(path, error) && !path.starts_with("/dev/") &&
         std::filesystem::exists(std::filesystem::canonical(path, error), error);
}

std::string ReadFile(const std::string& path, std::size_t limit) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(path + ": no such file");
  if (std::filesystem::is_directory(path, error))
    throw InputError(path + ": is a folder, allowed: a file");
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::character || kind == std::filesystem::file_type::block)
    throw InputError(path + ": is a device, allowed: a file");  // it may have no end
  if (IsNamedPipe(path))                                        // it may never get its writer
    throw InputError(path + ": is a named pipe, allowed: a file");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": " + std::generic_category().message(errno));
  std::string text;
  char block[1 << 16];
  while (text.size() < limit && in) {  // also the shell's pipes, which have no size
    in.read(block, static_cast<std::streamsize>(std::min(sizeof block, limit - text.size())));
    text.append(block, static_cast<std::size_t>(in.gcount()));
  }
  return text;
}

std::string Beside(const std::string& file, const std::string& name) {
  return name.starts_with('/')
             ? name
             : (std::filesystem::path(file).parent_path() / name).lexically_normal().string();
}

}  // namespace ambrig
