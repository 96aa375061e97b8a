#pragma once
/// A whole input file in memory.
#include <string>

namespace ambrig {

/// The first `limit` bytes of a file. @throws InputError "PATH: no such file" ...
std::string ReadFile(const std::string& path, std::size_t limit = std::string::npos);

}  // namespace ambrig
