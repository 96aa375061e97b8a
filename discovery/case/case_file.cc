#include "discovery/case/case_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/base/read_file.h"
#include "core/base/toml.h"
#include "core/base/toml_edit.h"

namespace ambrig {
namespace {

namespace fs = std::filesystem;

/// How `file` is named in a text that stands in `folder`.
std::string NameFrom(const fs::path& folder, const std::string& file) {
  return fs::absolute(file).lexically_normal().lexically_relative(folder).string();
}

}  // namespace

std::string CaseWithRig(const std::string& text, const std::string& file, const std::string& rig,
                        const std::string& output) {
  const fs::path folder = fs::absolute(output).lexically_normal().parent_path();
  std::vector<TomlEdit> edits{{"rig", NameFrom(folder, rig)}};
  const TomlTable table = TomlTable::FromText(text, file);
  const bool moved = fs::absolute(file).lexically_normal().parent_path() != folder;
  const std::vector<TomlTable> records = table.Tables("record");
  for (std::size_t k = 0; moved && k < records.size(); ++k)
    for (const char* key : {"scenario", "data"})
      if (records[k].IsString(key))
        if (const std::string name = records[k].String(key); !name.starts_with('/'))
          edits.push_back(
              {fmt::format("record[{}].{}", k, key), NameFrom(folder, Beside(file, name))});
  return EditedToml(text, file, edits);
}

}  // namespace ambrig
