#pragma once
/// The door to libzip: archives that are written whole and unpacked whole. Nobody else includes it.
#include <string>
#include <utility>
#include <vector>

namespace ambrig {

/// One file of an archive: its name inside ("binaries/linux64/rig.so") and its bytes.
using ZipEntry = std::pair<std::string, std::string>;

/// Appears complete or not at all; the same entries give the same bytes.
/// @throws InputError "cannot write PATH: reason".
void WriteZip(const std::string& path, const std::vector<ZipEntry>& entries);

/// Into an existing folder. @throws InputError when it is no zip file, is damaged, has a
/// name that leads out of the folder, or unpacks to more than 1 GiB.
void UnpackZip(const std::string& path, const std::string& folder);

}  // namespace ambrig
