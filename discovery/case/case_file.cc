#include "discovery/case/case_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/base/read_file.h"
#include "core/base/toml.h"
#include "core/base/toml_edit.h"

namespace ambrig {
namespace {

namespace fs = std::filesystem;

fs::path Whole(const std::string& path) { return (fs::current_path() / path).lexically_normal(); }

}  // namespace

std::string NameFrom(const std::string& folder, const std::string& file) {
  return Whole(file).lexically_relative(Whole(folder)).string();
}

std::string CaseWithRig(const std::string& text, const std::string& file, const std::string& rig,
                        const std::string& output) {
  const fs::path folder = Whole(output).parent_path();
  std::vector<TomlEdit> edits{{"rig", NameFrom(folder, rig)}};
  const TomlTable table = TomlTable::FromText(text, file);
  const bool moved = Whole(file).parent_path() != folder;
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
