#pragma once
/// A whole input file in memory, and where a file that it names is.
#include <string>

namespace ambrig {

/// Whether the path is a pipe that has a name in a folder, whose other end may never be opened; not
/// what the shell makes for <(...) and >(...), which is open already, nor
/// /dev/stdin and /dev/stdout.
bool IsNamedPipe(const std::string& path);

/// The first `limit` bytes of a file. @throws InputError "PATH: no such file" ...
std::string ReadFile(const std::string& path, std::size_t limit = std::string::npos);

/// `name` as `file` means it: relative to the folder of `file`.
std::string Beside(const std::string& file, const std::string& name);

}  // namespace ambrig
