#include "workbench/folder_index.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "core/base/json_file.h"
#include "core/base/toml.h"

namespace ambrig::workbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostFiles = 20000;
constexpr std::size_t kLargestText = 1 << 20;  // [bytes]

/// What a TOML file is, by what it holds.
std::string KindOfToml(const TomlTable& t) {
  if (t.Has("record")) return "case";
  if (t.Has("rotor") && t.Has("bearings")) return "rig";
  for (const char* key : {"scenarios", "seeds", "operation", "plants", "draws", "spread"})
    if (t.Has(key)) return "campaign";
  if (t.Has("duration")) return "scenario";
  return "other";
}

std::string KindByName(const std::string& name) {
  const std::string extension = std::filesystem::path(name).extension().string();
  if (extension == ".json") return "result";
  if (extension == ".html" || extension == ".svg") return "report";
  if (extension == ".md" || extension == ".txt") return "other";
  return "record";
}

/// What the list of cases shows of a result.
Json Summary(const Json& result, const std::string& command) {
  Json out{{"job", result["job"]}, {"fresh", result["fresh"]}};
  const Json& r = result["result"];
  const auto take = [&](const char* key) {
    if (r.contains(key)) out[key] = r[key];
  };
  if (command == "compare")
    for (const char* key : {"ratio", "ratio_fit", "ratio_validate"}) take(key);
  else
    for (const char* key : {"verdict", "final_ratio_validate", "nominal_ratio_validate"}) take(key);
  if (command == "explain" && r.contains("adopted")) {
    out["adopted"] = Json::array();
    for (const Json& a : r["adopted"])
      out["adopted"].push_back(a.value("effect", "") + " at " + a.value("target", ""));
  }
  return out;
}

}  // namespace

FolderIndex::Known& FolderIndex::About(const ServedFile& file) {
  Known& known = known_[file.name];
  if (known.changed == file.changed && known.size == file.size && !known.kind.empty()) return known;
  known = {file.changed, file.size, KindByName(file.name), "", 0, ""};
  if (!file.name.ends_with(".toml")) return known;
  known.kind = "other";
  try {
    const std::string text = folder_.Read(file.name, kLargestText);
    const TomlTable t = TomlTable::FromText(text, file.name);
    known.kind = KindOfToml(t);
    known.hash = HashText(text);
    if (known.kind == "case") known.records = t.Tables("record").size();
    if (known.kind == "case" && t.IsString("rig")) known.rig = t.String("rig");
  } catch (const InputError&) {
    known.kind = "broken";
  }
  return known;
}

std::string FolderIndex::HashOf(const std::string& name) {
  try {
    const int opened = folder_.OpenToRead(name);
    struct stat status {};
    ::fstat(opened, &status);
    ::close(opened);
    const double changed = static_cast<double>(status.st_mtim.tv_sec) +
                           1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
    const std::scoped_lock lock(mutex_);
    Known& known = About({name, static_cast<std::uint64_t>(status.st_size), changed});
    if (known.hash.empty()) known.hash = HashText(folder_.Read(name, std::size_t{16} << 30));
    return known.hash;
  } catch (const InputError&) {
    return "";
  }
}

nlohmann::ordered_json FolderIndex::Result(const std::string& command, const std::string& subject) {
  const int job = jobs_.Latest(command, subject);
  if (job == 0) return nullptr;
  Json out{{"job", job}};
  try {
    out["result"] = Json::parse(ReadJson(jobs_.FolderOf(job) + "/result.json").dump());
  } catch (const InputError&) {
    return nullptr;
  }
  Json stale = Json::array();
  const Json inputs =
      out["result"].value("provenance", Json::object()).value("inputs", Json::object());
  for (const auto& [file, hash] : inputs.items())
    if (HashOf(std::filesystem::path(file).lexically_normal().string()) != hash)
      stale.push_back(file);
  out["fresh"] = stale.empty();
  out["stale"] = stale;
  return out;
}

nlohmann::ordered_json FolderIndex::CaseJson(const ServedFile& file, const Known& known) {
  Json out{{"name", file.name}, {"records", known.records}, {"rig", known.rig}};
  for (const char* command : {"compare", "explain"}) {
    const Json result = Result(command, file.name);
    out[command] = result.is_null() ? Json() : Summary(result, command);
  }
  return out;
}

nlohmann::ordered_json FolderIndex::Folder() {
  Json files = Json::array(), cases = Json::array();
  std::vector<std::pair<ServedFile, Known>> found;
  for (const ServedFile& file : folder_.List(kMostFiles)) {
    const std::scoped_lock lock(mutex_);
    const Known& known = About(file);
    files.push_back({{"name", file.name},
                     {"kind", known.kind},
                     {"size", file.size},
                     {"changed", file.changed}});
    if (known.kind == "case") found.emplace_back(file, known);
  }
  for (const auto& [file, known] : found) cases.push_back(CaseJson(file, known));
  return {{"folder", std::filesystem::path(folder_.path()).filename().string()},
          {"files", files},
          {"cases", cases}};
}

}  // namespace ambrig::workbench
