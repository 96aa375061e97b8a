#pragma once
/// `ambrig diff` of two rig files.
#include <string>

#include "app/commands/commands.h"

namespace ambrig {

/// Whether the name is that of a rig file (.toml) and not of a record.
bool IsRigFile(const std::string& file);

/// Prints, and writes as JSON and HTML, only what differs. @return 0 when nothing does, else 1.
/// @throws InputError
int DiffRigs(const std::string& a, const std::string& b, const CommonOptions& common);

}  // namespace ambrig
