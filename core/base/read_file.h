#pragma once
/// A whole input file in memory, and where a file that it names is.
#include <string>

namespace ambrig {

/// The first `limit` bytes of a file. @throws InputError "PATH: no such file" ...
std::string ReadFile(const std::string& path, std::size_t limit = std::string::npos);

/// `name` as `file` means it: relative to the folder of `file`.
std::string Beside(const std::string& file, const std::string& name);

}  // namespace ambrig
