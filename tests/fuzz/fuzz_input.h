#pragma once
/// What every fuzz target needs. A reader either takes its input or refuses it with an InputError
/// of one line; a signal, a report of a sanitizer, another exception and a time-out are findings.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/base/errors.h"

namespace ambrig::fuzz {

inline std::string_view TextOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A file in memory with this content, for readers that take a path. Its extension is that of the
/// kind; one file a process.
inline std::string FileOf(const std::uint8_t* data, std::size_t size,
                          const std::string& extension) {
  static const std::filesystem::path folder = [] {
    std::string name = "/dev/shm/ambrig-fuzz-XXXXXX";
    if (mkdtemp(name.data()) == nullptr) std::abort();
    static struct Remover {
      std::string folder;
      ~Remover() { std::filesystem::remove_all(folder); }
    } remover{name};
    return std::filesystem::path(name);
  }();
  const std::string path = folder / ("input" + extension);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

/// Runs a reader; aborts where it refuses with no text or with more than one line.
template <typename Reader>
int TakesOrRefuses(const Reader& read) {
  try {
    read();
  } catch (const InputError& e) {
    const std::string_view said = e.what();
    if (said.empty() || said.find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}

}  // namespace ambrig::fuzz
