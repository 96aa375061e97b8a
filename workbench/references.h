#pragma once
/// Files that a file names: all of them in the served folder.
#include <map>
#include <string>

#include "workbench/served_folder.h"

namespace ambrig::workbench {

/// A file and every file that a rig, scenario, case or campaign names, however deep; of TOML files
/// with their texts, of others with "". @throws InputError when one lies outside the folder or is
/// not there
std::map<std::string, std::string> FilesNamedBy(const ServedFolder& folder,
                                                const std::string& file);

/// `text` of a file that stood in `from`, as it must read in `to` to name the same files; both
/// relative to the folder. @throws InputError as FilesNamedBy
std::string MovedText(const ServedFolder& folder, const std::string& text, const std::string& from,
                      const std::string& to);

}  // namespace ambrig::workbench
