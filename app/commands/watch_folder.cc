#include "app/commands/watch_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "app/commands/commands.h"
#include "app/json/provenance.h"
#include "app/json/watch_json.h"
#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "core/base/json_file.h"
#include "core/base/read_file.h"
#include "core/base/toml.h"
#include "core/record/formats/format.h"
#include "discovery/case/case_file.h"
#include "discovery/watch/watched_record.h"

namespace ambrig {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Above this the reference is not explained, and what is missing from the model hides what
/// changes.
constexpr double kUnexplained = 1.5;

/// Of a record, not of a text that ambrig writes beside records.
bool IsRecordName(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension.empty() || file.filename().string().starts_with('.')) return false;
  return std::ranges::any_of(RecordFormats(), [&](const RecordFormat& f) {
    return (" " + std::string(f.extensions) + " ").find(" " + extension + " ") != std::string::npos;
  });
}

/// Whether an entry of the journal has what is looked up in it; one of another version is examined
/// again.
bool IsWatchEntry(const Json& e) {
  const auto is_text = [](const Json& of, const char* key) {
    return of.is_object() && of.contains(key) && of[key].is_string();
  };
  if (!is_text(e, "kind") || !is_text(e, "model")) return false;
  if (e["kind"] != "record") return true;
  return is_text(e, "data") && is_text(e, "hash") && e.contains("size") && e.contains("changed") &&
         e.contains("left") && std::ranges::all_of(e["left"], [&](const Json& band) {
           return is_text(band, "kind") && is_text(band, "name");
         });
}

/// What left its band, by name: the same things as before need no explanation of their own.
std::string LeftNames(const Json& left) {
  std::string names;
  for (const Json& b : left) names += b.at("kind").get<std::string>() + b.at("name").dump();
  return names;
}

}  // namespace

FolderWatch::FolderWatch(WatchOptions options) : options_(std::move(options)) {
  if (!fs::is_directory(options_.folder))
    throw InputError(options_.folder + ": is no folder, allowed: the folder of the logger");
  const Case c = ReadCase(options_.case_file);
  case_text_ = ReadFile(c.file);
  rig_text_ = ReadFile(c.rig_file);
  stems_ = RecordStems(case_text_, c.file);
  for (const CaseRecord& r : c.records) data_files_.push_back(r.data_file);
  const std::string wanted = "ambrig watch 1 " + fs::path(c.file).filename().string();
  journal_ = std::make_unique<Journal>(
      options_.journal, wanted,
      JournalVisitor{[&](std::string_view header) {
                       if (header != wanted)
                         throw InputError(fmt::format(
                             "{}: is no journal of ambrig watch for {}, allowed: --journal with "
                             "another file",
                             options_.journal, options_.case_file));
                     },
                     [&](const JournalEntry& e) {
                       Json entry = Json::parse(e.text, nullptr, false);
                       if (!IsWatchEntry(entry)) return false;
                       entries_.push_back(std::move(entry));
                       return true;
                     }});
}

void FolderWatch::Keep(const Json& entry) {
  journal_->Append(JsonText(entry));
  entries_.push_back(entry);
}

bool FolderWatch::Known(const Found& file) const {
  std::string hash;
  for (const Json& e : entries_) {
    if (e["kind"] != "record" || e["data"] != file.name) continue;
    if (e["size"] == file.size && e["changed"] == file.changed) return true;
    if (hash.empty()) hash = FileHash(file.path);
    if (e["hash"] == hash) return true;
  }
  return false;
}

std::vector<FolderWatch::Found> FolderWatch::NewFiles() {
  const double now =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  std::vector<Found> found;
  waiting_.clear();
  std::error_code error;
  fs::recursive_directory_iterator entry(options_.folder,
                                         fs::directory_options::skip_permission_denied, error),
      end;
  for (; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().string().starts_with('.')) {
      entry.disable_recursion_pending();
      continue;
    }
    struct stat status {};
    if (!IsRecordName(entry->path()) || ::stat(entry->path().c_str(), &status) != 0 ||
        !S_ISREG(status.st_mode))
      continue;
    std::error_code ignored;
    if (std::ranges::any_of(data_files_, [&](const std::string& own) {
          return fs::equivalent(own, entry->path(), ignored);
        }))
      continue;
    const double changed = static_cast<double>(status.st_mtim.tv_sec) +
                           1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
    const Found file{entry->path().lexically_relative(options_.folder).string(),
                     entry->path().string(), static_cast<std::uint64_t>(status.st_size), changed};
    if (Known(file)) continue;
    if (now - changed < options_.settle && changed <= now)
      waiting_.push_back(file.name);
    else
      found.push_back(file);
  }
  std::ranges::sort(waiting_);
  std::ranges::sort(found, [](const Found& a, const Found& b) {
    return std::tie(a.changed, a.name) < std::tie(b.changed, b.name);
  });
  return found;
}

RecordState FolderWatch::ReferenceOf(std::size_t record, const std::string& model) {
  for (const Json& e : entries_)
    if (e["kind"] == "reference" && e["model"] == model) try {
        return ReferenceFromJson(e);
      } catch (const nlohmann::json::exception&) {
        continue;
      }
  const Case c =
      ReadCaseText(CaseOfOneRecord(case_text_, options_.case_file, record, data_files_[record]),
                   options_.case_file);
  const RecordState state = StateOf(c, nullptr, &interrupted);
  if (!state.faults.empty())
    throw InputError(fmt::format("{}: its own record is wrong, allowed: a mended case: {}",
                                 options_.case_file, FaultText(state.faults[0])));
  Json entry{{"kind", "reference"}, {"model", model}, {"of", stems_[record]}};
  entry.update(StateJson(state, nullptr));
  Keep(entry);
  return state;
}

void FolderWatch::Explained(const std::string& text, Json& entry, const Progress& progress) {
  for (auto e = entries_.rbegin(); e != entries_.rend(); ++e) {
    if ((*e)["kind"] != "record" || (*e)["model"] != entry["model"]) continue;
    if (!e->contains("explanation") || LeftNames((*e)["left"]) != LeftNames(entry["left"])) break;
    entry["explanation"] = (*e)["explanation"];
    if (!entry["explanation"].contains("of")) entry["explanation"]["of"] = (*e)["data"];
    return;
  }
  ExplainOptions options;
  options.candidates = options_.candidates;
  options.stop = &interrupted;
  options.progress = [&](double f, const std::string& t) {
    progress(0.3 + 0.7 * f, entry["data"].get<std::string>() + ": " + t);
  };
  entry["explanation"] =
      WatchExplanationJson(Explain(ReadCaseText(text, options_.case_file), options));
}

Json FolderWatch::Examine(const Found& file, const Progress& progress) {
  Json entry{{"kind", "record"},     {"data", file.name},       {"hash", FileHash(file.path)},
             {"size", file.size},    {"changed", file.changed}, {"model", ""},
             {"left", Json::array()}};
  const auto refuse = [&](const std::string& why) {
    entry["state"] = "refused";
    entry["error"] = why;
    return entry;
  };
  const int repeated = RepeatedRecord(stems_, file.name);
  if (repeated < 0)
    return refuse(file.name +
                  ": repeats no record of the case, allowed: a name that begins as the name of one "
                  "of its data files");
  const auto record = static_cast<std::size_t>(repeated);
  const std::string own = CaseOfOneRecord(case_text_, options_.case_file, record, "/");
  entry["of"] = stems_[record];
  entry["model"] = HashText(own + rig_text_);
  progress(0.02, "reference " + stems_[record]);
  const RecordState reference = ReferenceOf(record, entry["model"]);
  progress(0.15, file.name);
  const std::string text = CaseOfOneRecord(case_text_, options_.case_file, record, file.path);
  try {
    const RecordState state =
        StateOf(ReadCaseText(text, options_.case_file), &reference, &interrupted);
    entry.update(StateJson(state, &reference));
    const std::vector<LeftBand> left = FindLeftBands(state, reference);
    if (state.faults.empty()) entry["left"] = LeftJson(left);
    entry["state"] = !state.faults.empty() ? "data" : left.empty() ? "ok" : "left";
    if (entry["state"] == "left" && options_.explain) Explained(text, entry, progress);
  } catch (const InputError& e) {
    const std::string what = e.what();  // may name the case's line alone
    return refuse(what.find(file.name) == std::string::npos ? file.name + ": " + what : what);
  }
  return entry;
}

std::vector<std::string> FolderWatch::Pass(const Progress& progress,
                                           const std::function<void(const Json&)>& told) {
  std::vector<std::string> names;
  const std::vector<Found> files = NewFiles();
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (interrupted) throw Interrupted();
    const double each = 1 / static_cast<double>(files.size());
    const Json entry = Examine(files[k], [&](double f, const std::string& text) {
      progress((static_cast<double>(k) + f) * each, text);
    });
    entries_.push_back(entry);
    names.push_back(files[k].name);
    told(entry);
    journal_->Append(JsonText(entry));  // last: what could not be told is examined again
  }
  return names;
}

Json FolderWatch::Document() const {
  Json references = Json::array(), warnings = Json::array();
  std::vector<Json> records;
  for (const Json& e : entries_)
    if (e["kind"] == "record")
      records.push_back(e);
    else
      references.push_back(e);
  std::ranges::stable_sort(records, [](const Json& a, const Json& b) {
    return a["changed"].get<double>() < b["changed"].get<double>();
  });
  for (const Json& r : references)
    if (r["ratio_fitted"].is_number() && r["ratio_fitted"].get<double>() > kUnexplained)
      warnings.push_back(
          fmt::format("{} itself is not explained ({:.1f} times the noise is left): adopt what is "
                      "missing first "
                      "(ambrig explain), or an explanation names that",
                      r["of"].get<std::string>(), r["ratio_fitted"].get<double>()));
  return {{"case", options_.case_file}, {"folder", options_.folder}, {"journal", options_.journal},
          {"references", references},   {"records", records},        {"waiting", waiting_},
          {"warnings", warnings}};
}

}  // namespace ambrig
