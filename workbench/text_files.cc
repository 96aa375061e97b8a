#include "workbench/text_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "core/base/json_file.h"
#include "core/base/toml.h"

namespace ambrig::workbench {
namespace {

namespace fs = std::filesystem;

/// The line number in "case.toml:31: record[4].data".
std::size_t LineOf(const std::string& where, const std::string& file) {
  return std::stoul(where.substr(file.size() + 1));
}

/// Offset behind line number `line`, from 1.
std::size_t BehindLine(const std::string& text, std::size_t line) {
  std::size_t at = 0;
  for (; line > 0 && at != std::string::npos; --line) {
    at = text.find('\n', at);
    if (at != std::string::npos) ++at;
  }
  return at == std::string::npos ? text.size() : at;
}

}  // namespace

std::string MendedCase(const std::string& text, const std::string& file, const std::string& data,
                       const std::string& mend, int* line) {
  if (mend.empty() || mend.find_first_of("\r\n") != std::string::npos)
    throw InputError("mend: allowed: one line of a [[record]]");
  for (const TomlTable& record : TomlTable::FromText(text, file).Tables("record")) {
    const std::string name = record.String("data");
    if (name != data && fs::path(name).filename() != fs::path(data).filename()) continue;
    const std::size_t above = LineOf(record.Where("data"), file);
    std::string out = text;
    const std::size_t at = BehindLine(out, above);
    const bool ended = at == 0 || out[at - 1] == '\n';
    out.insert(at, (ended ? "" : "\n") + mend + "\n");
    *line = static_cast<int>(above) + 1;
    try {
      TomlTable::FromText(out, file);
    } catch (const InputError& e) {
      throw InputError(
          fmt::format("{} cannot be added, the record already says something of it; "
                      "put it in by hand: {}",
                      mend, e.what()));
    }
    return out;
  }
  throw InputError(fmt::format("{}: has no record with data = \"{}\"", file, data));
}

TextFiles::TextFiles(const ServedFolder& folder) : folder_(folder) {
  std::error_code error;
  const fs::path trash = fs::path(folder_.path()) / ".ambrig" / "trash";
  fs::create_directories(trash, error);
  for (const auto& entry : fs::directory_iterator(trash, error))
    if (entry.path().extension() == ".json")
      last_ = std::max(last_, std::atoi(entry.path().stem().c_str()));
}

std::string TextFiles::TrashOf(int step) const {
  return fmt::format("{}/.ambrig/trash/{}.json", folder_.path(), step);
}

int TextFiles::ReplaceLocked(const std::string& name, const std::string& text,
                             const std::string& hash) {
  const bool there = folder_.Has(name);
  const std::string old = there ? folder_.Read(name, kLargest) : "";
  if (there ? HashText(old) != hash : !hash.empty()) throw Conflict{there ? HashText(old) : ""};
  const int step = ++last_;
  const nlohmann::ordered_json kept{
      {"file", name}, {"there", there}, {"old", old}, {"written", HashText(text)}};
  // The old version is on the disk before the new one replaces it.
  WriteFileAtomically(TrashOf(step),
                      kept.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  folder_.Write(name, text);
  return step;
}

void TextFiles::CheckWritable(const std::string& name) {
  if (!name.ends_with(".toml") && !name.ends_with(".txt") && !name.ends_with(".md"))
    throw InputError(name + ": allowed to be written: .toml, .txt, .md");
}

int TextFiles::Remove(const std::string& name, const std::string& hash) {
  CheckWritable(name);
  const std::scoped_lock lock(mutex_);
  const std::string old = folder_.Read(name, kLargest);
  if (HashText(old) != hash) throw Conflict{HashText(old)};
  const int step = ++last_;
  const nlohmann::ordered_json kept{{"file", name}, {"there", true}, {"old", old}, {"written", ""}};
  WriteFileAtomically(TrashOf(step),
                      kept.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  folder_.Remove(name);
  return step;
}

int TextFiles::Replace(const std::string& name, const std::string& text, const std::string& hash) {
  CheckWritable(name);
  const std::scoped_lock lock(mutex_);
  return ReplaceLocked(name, text, hash);
}

int TextFiles::NoteAdded(const std::string& name) {
  const std::scoped_lock lock(mutex_);
  const int step = ++last_;
  WriteFileAtomically(
      TrashOf(step),
      nlohmann::ordered_json{{"file", name}, {"added", folder_.Version(name)}}.dump());
  return step;
}

nlohmann::ordered_json TextFiles::Undo(int step) {
  const std::scoped_lock lock(mutex_);
  if (step < 1 || step > last_) throw InputError("undo: there is no such step");
  const nlohmann::json kept = ReadJson(TrashOf(step));
  if (kept.contains("added")) {
    const std::string file = kept.at("file");
    if (folder_.Version(file) != kept.at("added")) throw Conflict{""};
    folder_.MoveOut(file, fmt::format("{}/.ambrig/trash/{}.file", folder_.path(), step));
    return {{"file", file}, {"removed", true}};
  }
  const std::string name = kept.at("file"), old = kept.at("old"), written = kept.at("written");
  const std::string now = folder_.Has(name) ? HashText(folder_.Read(name, kLargest)) : "";
  if (now != written) throw Conflict{now};
  if (kept.at("there").get<bool>())
    folder_.Write(name, old);
  else
    folder_.Remove(name);
  return {{"file", name}, {"removed", !kept.at("there").get<bool>()}};
}

nlohmann::ordered_json TextFiles::Mend(const std::string& case_file, const std::string& data,
                                       const std::string& mend) {
  const std::scoped_lock lock(mutex_);
  const std::string old = folder_.Read(case_file, kLargest);
  int line = 0;
  const std::string text = MendedCase(old, case_file, data, mend, &line);
  const int step = ReplaceLocked(case_file, text, HashText(old));
  return {{"step", step}, {"text", mend}, {"line", line}};
}

}  // namespace ambrig::workbench
