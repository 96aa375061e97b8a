#pragma once
/// rig.toml. Source: docs/guide/files.md.
#include <string>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// @throws InputError with file:line for every wrong key, type, value or contradiction.
RigParameters ReadRig(const std::string& file);
RigParameters ReadRigText(const std::string& text, const std::string& file_name);

}  // namespace ambrig
