#include "workbench/folder_index.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
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

/// What the lists show of a result.
Json Summary(const Json& r, const std::string& command) {
  Json out = Json::object();
  for (const char* key :
       {"ratio", "ratio_fit", "ratio_validate", "verdict", "final_ratio_validate",
        "nominal_ratio_validate", "drop", "touchdown", "runs", "done", "up", "error"})
    if (r.contains(key)) out[key] = r[key];
  if (command == "run" && r.contains("metrics"))
    for (const char* key : {"max_orbit", "peak_current"})
      if (r["metrics"].contains(key)) out[key] = r["metrics"][key];
  if (command == "run" && r.contains("events") && r["events"].is_array())
    for (const Json& e : r["events"]) {
      const std::string kind = e.value("kind", "");
      if ((kind == "fault" || kind == "detected") && !out.contains(kind))
        out[kind] = e.value("t", 0.0);
    }
  if (command == "watch" && r.contains("records")) {
    out["records"] = r["records"].size();
    out["left"] = std::count_if(r["records"].begin(), r["records"].end(), [](const Json& record) {
      return record.value("state", "") != "ok";
    });
  }
  if (command == "explain" && r.contains("adopted")) {
    out["adopted"] = Json::array();
    for (const Json& a : r["adopted"])
      out["adopted"].push_back(a.value("effect", "") + " at " + a.value("target", ""));
  }
  return out;
}

Json InputsOf(const Json& result) {
  return result.value("provenance", Json::object()).value("inputs", Json::object());
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
  out["stale"] = StaleOf(InputsOf(out["result"]));
  out["fresh"] = out["stale"].empty();
  return out;
}

Json FolderIndex::StaleOf(const Json& inputs) {
  Json stale = Json::array();
  for (const auto& [file, hash] : inputs.items()) {
    const std::string name = std::filesystem::path(file).lexically_normal().string();
    // What the server wrote for the job itself does not change.
    if (!name.starts_with(".ambrig/") && HashOf(name) != hash) stale.push_back(file);
  }
  return stale;
}

Json FolderIndex::Short(const std::string& command, int job) {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = short_.find(job); found != short_.end()) return found->second;
  }
  Json kept;
  try {
    const Json result = Json::parse(ReadJson(jobs_.FolderOf(job) + "/result.json").dump());
    kept = {{"summary", Summary(result, command)}, {"inputs", InputsOf(result)}};
  } catch (const InputError&) {
    kept = nullptr;
  }
  const std::scoped_lock lock(mutex_);
  return short_[job] = kept;
}

Json FolderIndex::SubjectJson(const std::string& name, const std::vector<const char*>& commands) {
  Json out{{"name", name}};
  for (const char* command : commands) {
    const int job = jobs_.Latest(command, name);
    const Json kept = job == 0 ? Json() : Short(command, job);
    if (kept.is_null()) {
      out[command] = nullptr;
      continue;
    }
    out[command] = kept["summary"];
    out[command]["job"] = job;
    out[command]["fresh"] = StaleOf(kept["inputs"]).empty();
  }
  return out;
}

nlohmann::ordered_json FolderIndex::CaseJson(const ServedFile& file, const Known& known) {
  Json out = SubjectJson(file.name, {"compare", "explain", "watch"});
  out["records"] = known.records;
  out["rig"] = known.rig;
  return out;
}

nlohmann::ordered_json FolderIndex::Folder() {
  Json files = Json::array(), cases = Json::array(), scenarios = Json::array(),
       campaigns = Json::array();
  std::vector<std::pair<ServedFile, Known>> found;
  for (const ServedFile& file : folder_.List(kMostFiles)) {
    const std::scoped_lock lock(mutex_);
    const Known& known = About(file);
    files.push_back({{"name", file.name},
                     {"kind", known.kind},
                     {"size", file.size},
                     {"changed", file.changed}});
    if (known.kind == "case" || known.kind == "scenario" || known.kind == "campaign")
      found.emplace_back(file, known);
  }
  for (const auto& [file, known] : found)
    if (known.kind == "case")
      cases.push_back(CaseJson(file, known));
    else if (known.kind == "scenario")
      scenarios.push_back(SubjectJson(file.name, {"run"}));
    else
      campaigns.push_back(SubjectJson(file.name, {"campaign"}));
  return {{"folder", std::filesystem::path(folder_.path()).filename().string()},
          {"files", files},
          {"cases", cases},
          {"scenarios", scenarios},
          {"campaigns", campaigns}};
}

}  // namespace ambrig::workbench
