#include "campaign/journal.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/fingerprint.h"
#include "core/base/read_file.h"

namespace ambrig {

namespace {

constexpr int kVersion = 1;

std::string PathOf(const std::string& folder) {
  return (std::filesystem::path(folder) / "journal.txt").string();
}

std::string HeaderText(const JournalHeader& h) {
  return nlohmann::ordered_json{{"ambrig_campaign", kVersion},
                                {"name", h.name},
                                {"file", h.file},
                                {"fingerprint", h.fingerprint},
                                {"runs", h.runs}}
      .dump();
}

JournalHeader ParseHeader(std::string_view text, const std::string& path) {
  try {
    const auto json = nlohmann::json::parse(text);
    if (json.at("ambrig_campaign") == kVersion)
      return {json.at("name"), json.at("file"), json.at("fingerprint"), json.at("runs")};
  } catch (const nlohmann::json::exception&) {
    // Said below in our words.
  }
  throw InputError(fmt::format("{}:1: not a campaign's journal of this version", path));
}

JournalContent Parse(const std::string& text, const std::string& path) {
  JournalContent out;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const bool whole = end < text.size();
    const std::string_view content =
        whole ? Unchecked(std::string_view(text).substr(begin, end - begin)) : std::string_view{};
    begin = end + 1;
    if (++number == 1) {
      out.header = ParseHeader(content, path);
      continue;
    }
    if (content.empty()) {
      ++out.damaged;
      continue;
    }
    Row row = ParseRow(content, fmt::format("{}:{}", path, number));
    if (row.run >= out.header.runs)
      throw InputError(fmt::format("{}:{}: run = {}, allowed: 0 to {}", path, number, row.run,
                                   out.header.runs - 1));
    const std::size_t run = row.run;
    out.rows.insert_or_assign(run, std::move(row));
  }
  return out;
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
  const std::string path = PathOf(folder), text = ReadFile(path);
  if (text.empty())
    throw InputError(fmt::format("{}:1: not a campaign's journal of this version", path));
  return Parse(text, path);
}

Journal::Journal(const std::string& folder, const JournalHeader& header) : file_(PathOf(folder)) {
  const std::string& path = file_.path();
  const std::string text = ReadFile(path);
  // Without a whole first line nothing was recorded yet.
  if (text.find('\n') == std::string::npos) {
    file_.Truncate(0);
    file_.Append(CheckedLine(HeaderText(header)));
    return;
  }
  JournalContent content = Parse(text, path);
  if (content.header.fingerprint != header.fingerprint || content.header.runs != header.runs)
    throw InputError(
        fmt::format("{}: holds runs of {} before it, its rig or a scenario was changed; allowed: "
                    "the same files, or another folder with -o",
                    path, content.header.file));
  rows_ = std::move(content.rows);
  damaged_ = content.damaged;
  // A half line is ended, so that the next one stands alone.
  if (!text.ends_with('\n')) file_.Append("\n");
}

void Journal::Append(const Row& row) {
  const std::string line = CheckedLine(row.Csv());
  const std::scoped_lock lock(mutex_);
  file_.Append(line);
  rows_.insert_or_assign(row.run, row);
}

void WriteTable(const std::string& folder, const Rows& rows) {
  std::string text;
  for (const std::string& column : RowColumns()) text += (text.empty() ? "" : ",") + column;
  text += '\n';
  for (const auto& [run, row] : rows) text += row.Csv() + '\n';
  WriteFileAtomically((std::filesystem::path(folder) / "table.csv").string(), text);
}

}  // namespace ambrig
