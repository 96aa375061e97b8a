/// Files that a file names: all of them in the served folder.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/base/errors.h"
#include "core/base/toml.h"
#include "workbench/job_table.h"

namespace ambrig::workbench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestReference = 16 << 20;  // [bytes]
/// Keys whose text is the name of a file that is read.
constexpr const char* kFileKeys[] = {"rig",           "scenario", "data",     "file",
                                     "commissioning", "campaign", "baseline", "tolerances"};

class ReferenceWalk {
 public:
  explicit ReferenceWalk(const ServedFolder& folder) : folder_(folder) {}

  void File(const std::string& name) {
    if (!seen_.insert(name).second) return;
    if (seen_.size() > 2000) throw InputError(name + ": names too many files");
    if (!name.ends_with(".toml")) {
      const std::string text = folder_.Has(name) ? "" : folder_.Read(name, 0);  // says why not
      return;
    }
    const TomlTable root = TomlTable::FromText(folder_.Read(name, kLargestReference), name);
    Table(root, name);
  }

 private:
  void Table(const TomlTable& t, const std::string& file) {
    for (const std::string& key : t.Keys()) {
      if (t.IsTable(key)) {
        Table(*t.Table(key), file);
      } else if (t.IsString(key)) {
        if (std::find(std::begin(kFileKeys), std::end(kFileKeys), key) != std::end(kFileKeys))
          Named(t, key, file);
      } else if (t.IsArray(key)) {
        Array(t, key, file);
      }
    }
  }

  /// Tables of an array; an array of anything else names no file.
  void Array(const TomlTable& t, const std::string& key, const std::string& file) {
    std::vector<TomlTable> rows;
    try {
      rows = t.Tables(key);
    } catch (const InputError&) {
      return;
    }
    for (const TomlTable& row : rows) Table(row, file);
  }

  void Named(const TomlTable& t, const std::string& key, const std::string& file) {
    const std::string name = t.String(key);
    // "rig" is also a target's name, and a text with a blank line is no file.
    if (fs::path(name).extension().empty() && !name.starts_with('/') &&
        name.find("..") == std::string::npos)
      return;
    const std::string there = (fs::path(file).parent_path() / name).lexically_normal().string();
    if (name.starts_with('/') || there.starts_with(".."))
      throw InputError(
          fmt::format("{} names {} outside the served folder, allowed: ambrig serve "
                      "with the folder above",
                      t.Where(key), name));
    if (folder_.Has(there) || fs::path(there).extension() == ".toml") File(there);
    if (!folder_.Has(there)) folder_.Read(there, 0);
  }

  const ServedFolder& folder_;
  std::set<std::string> seen_;
};

}  // namespace

void RefuseOutside(const ServedFolder& folder, const std::string& file) {
  ReferenceWalk(folder).File(file);
}

}  // namespace ambrig::workbench
