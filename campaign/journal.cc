#include "campaign/journal.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/json_file.h"

namespace ambrig {

namespace {

constexpr int kVersion = 1;
constexpr std::size_t kTableBlock = 1 << 20;  // of a table, written at once [bytes]

std::string PathOf(const std::string& folder) {
  return (std::filesystem::path(folder) / "journal.txt").string();
}

std::string HeaderText(const JournalHeader& h) {
  return JsonText(nlohmann::ordered_json{{"ambrig_campaign", kVersion},
                                         {"name", h.name},
                                         {"file", h.file},
                                         {"fingerprint", h.fingerprint},
                                         {"runs", h.runs}});
}

JournalHeader ParseHeader(std::string_view text, const std::string& path) {
  try {
    const auto json = nlohmann::json::parse(text);
    const auto& runs = json.at("runs");
    if (json.at("ambrig_campaign") == kVersion && runs.is_number_unsigned() && runs >= 1 &&
        runs <= kMostRuns)
      return {json.at("name"), json.at("file"), json.at("fingerprint"), runs};
  } catch (const nlohmann::json::exception&) {
    // Said below in our words.
  }
  throw InputError(fmt::format("{}:1: not a campaign's journal of this version", path));
}

/// Takes the rows of the journal at `path` into `content`. Detector studies keep rows of another
/// table in a journal like this.
JournalVisitor Into(JournalContent& content, const std::string& path, const RowCheck& check) {
  const auto header = [&content, path](std::string_view text) {
    content.header = ParseHeader(text, path);
  };
  const auto entry = [&content, path, check](const JournalEntry& e) {
    const std::string where = fmt::format("{}:{}", path, e.line);
    Row row = ParseRow(e.text, where);
    if (row.run >= content.header.runs)
      throw InputError(
          fmt::format("{}: run = {}, allowed: 0 to {}", where, row.run, content.header.runs - 1));
    check(row, where);
    const std::size_t run = row.run;
    content.rows.insert_or_assign(run, std::move(row));
    return true;
  };
  return {header, entry};
}

}  // namespace

JournalHeader HeaderOf(const Campaign& c) {
  return {c.name, std::filesystem::absolute(c.file).lexically_normal().string(), c.fingerprint,
          c.runs()};
}

bool HasJournal(const std::string& folder) { return std::filesystem::exists(PathOf(folder)); }

JournalContent ReadJournal(const std::string& folder) {
  if (!HasJournal(folder))
    throw InputError(
        fmt::format("{}: no campaign's results, allowed: a folder with journal.txt", folder));
  JournalContent out;
  out.damaged = ReadJournalFile(PathOf(folder), Into(out, PathOf(folder), CheckRow));
  return out;
}

CampaignJournal::CampaignJournal(const std::string& folder, const JournalHeader& header,
                                 const RowCheck& check)
    : journal_(PathOf(folder), HeaderText(header), Into(content_, PathOf(folder), check)) {
  const JournalHeader& found = content_.header;
  if (found.fingerprint.empty()) return;  // begun just now
  if (found.fingerprint != header.fingerprint || found.runs != header.runs)
    throw InputError(
        fmt::format("{}: holds runs of {} before it, its rig or a scenario was changed; allowed: "
                    "the same files, or another folder with -o",
                    journal_.path(), found.file));
}

void CampaignJournal::Append(Row row) {
  journal_.Append(row.csv);
  const std::scoped_lock lock(mutex_);
  const std::size_t run = row.run;
  content_.rows.insert_or_assign(run, std::move(row));
}

void WriteTable(const std::string& folder, const Rows& rows) {
  std::string text;
  for (const std::string& column : RowColumns()) text += (text.empty() ? "" : ",") + column;
  text += '\n';
  AtomicFile file((std::filesystem::path(folder) / "table.csv").string());
  for (const auto& [run, row] : rows) {
    text += row.csv + '\n';
    if (text.size() < kTableBlock) continue;
    file.Write(text);
    text.clear();
  }
  file.Write(text);
  file.Commit();
}

}  // namespace ambrig
