#include "workbench/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <span>

#include "core/base/errors.h"
#include "core/base/toml.h"
#include "core/base/toml_edit.h"

namespace ambrig::workbench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestReference = 16 << 20;  // [bytes]
constexpr std::size_t kMostReferences = 2000;
/// Keys whose text is the name of a file that is read.
constexpr const char* kFileKeys[] = {"rig",           "scenario", "data",     "file",
                                     "commissioning", "campaign", "baseline", "tolerances"};
/// Keys whose list holds names of files.
constexpr const char* kFileLists[] = {"scenarios"};

bool IsOneOf(std::span<const char* const> keys, const std::string& key) {
  return std::any_of(keys.begin(), keys.end(), [&](const char* k) { return key == k; });
}

/// The file that is named so in `file`, relative to the folder; "" for a text that is no file:
/// "rig" is also a target's name, "none" a commissioning.
std::string Resolved(const ServedFolder& folder, const TomlTable& t, const std::string& key,
                     const std::string& name, const std::string& file) {
  if (fs::path(name).extension().empty() && !name.starts_with('/') &&
      name.find("..") == std::string::npos)
    return "";
  const fs::path there = name.starts_with('/')
                             ? fs::path(name).lexically_normal().lexically_relative(folder.path())
                             : (fs::path(file).parent_path() / name).lexically_normal();
  if (there.empty() || there.is_absolute() || *there.begin() == "..")
    throw InputError(
        fmt::format("{} names {} outside the served folder, allowed: ambrig serve "
                    "with the folder above",
                    t.Where(key), name));
  return there.string();
}

/// Calls `found` with every place of a table that names a file.
class FileNames {
 public:
  using Found = std::function<void(const TomlTable& t, const std::string& key,
                                   const std::string& path, const std::string& name)>;
  explicit FileNames(Found found) : found_(std::move(found)) {}

  void Table(const TomlTable& t, const std::string& path) const {
    for (const std::string& key : t.Keys()) {
      const std::string here = path.empty() ? key : path + "." + key;
      if (t.IsTable(key))
        Table(*t.Table(key), here);
      else if (t.IsString(key) && IsOneOf(kFileKeys, key))
        found_(t, key, here, t.String(key));
      else if (t.IsArray(key))
        Array(t, key, here);
    }
  }

 private:
  /// Tables of an array, or names in a list of files; an array of anything else names no file.
  void Array(const TomlTable& t, const std::string& key, const std::string& here) const {
    if (IsOneOf(kFileLists, key)) {
      std::size_t k = 0;
      for (const std::string& name : t.Strings(key))
        found_(t, key, fmt::format("{}[{}]", here, k++), name);
      return;
    }
    std::vector<TomlTable> rows;
    try {
      rows = t.Tables(key);
    } catch (const InputError&) {
      return;
    }
    for (std::size_t k = 0; k < rows.size(); ++k) Table(rows[k], fmt::format("{}[{}]", here, k));
  }

  const Found found_;
};

class ReferenceWalk {
 public:
  explicit ReferenceWalk(const ServedFolder& folder) : folder_(folder) {}

  void File(const std::string& name) {
    if (files.contains(name)) return;
    files[name] = "";
    if (files.size() > kMostReferences) throw InputError(name + ": names too many files");
    if (!name.ends_with(".toml")) {
      if (!folder_.Has(name)) folder_.Read(name, 0);  // says why not
      return;
    }
    files[name] = folder_.Read(name, kLargestReference);
    Text(files[name], name);
  }

  void Text(const std::string& text, const std::string& name) {
    const TomlTable root = TomlTable::FromText(text, name);
    FileNames([&](const TomlTable& t, const std::string& key, const std::string&,
                  const std::string& named) {
      const std::string file = Resolved(folder_, t, key, named, name);
      if (!file.empty()) File(file);
    }).Table(root, "");
  }

  std::map<std::string, std::string> files;

 private:
  const ServedFolder& folder_;
};

}  // namespace

std::map<std::string, std::string> FilesNamedBy(const ServedFolder& folder,
                                                const std::string& file) {
  ReferenceWalk walk(folder);
  walk.File(file);
  return walk.files;
}

std::string MovedText(const ServedFolder& folder, const std::string& text, const std::string& from,
                      const std::string& to) {
  ReferenceWalk(folder).Text(text, from);
  std::vector<TomlEdit> edits;
  const fs::path target = fs::path("/" + to).parent_path();
  FileNames([&](const TomlTable& t, const std::string& key, const std::string& path,
                const std::string& named) {
    const std::string file = Resolved(folder, t, key, named, from);
    if (!file.empty())
      edits.push_back({path, fs::path("/" + file).lexically_relative(target).string()});
  }).Table(TomlTable::FromText(text, from), "");
  return EditedToml(text, from, edits);
}

}  // namespace ambrig::workbench
