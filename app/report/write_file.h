#pragma once
/// A file is there complete or not at all: written beside its place, synced, renamed.
#include <filesystem>
#include <string_view>

namespace ambrig {

/// Makes the folder when it is missing. @throws InputError "PATH: cannot be written: reason".
void WriteFileAtomically(const std::filesystem::path& path, std::string_view text);

}  // namespace ambrig
