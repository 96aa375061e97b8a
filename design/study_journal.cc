#include "design/study_journal.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>

#include "core/base/errors.h"

namespace ambrig {

namespace {

std::string PathOf(const std::string& folder) {
  return (std::filesystem::path(folder) / "journal.txt").string();
}

std::string Numbers(const std::vector<double>& values) {
  std::string text;
  for (const double v : values)
    text += (text.empty() ? "" : " ") +
            (std::isinf(v) ? std::string(v > 0 ? "inf" : "-inf") : NumberText(v));
  return text;
}

std::string Key(std::size_t candidate, const std::vector<double>& values) {
  return fmt::format("{}: {}", candidate, Numbers(values));
}

bool ParseNumbers(std::string_view text, std::vector<double>& out) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    double v = 0;
    const auto [last, error] = std::from_chars(text.data(), text.data() + end, v);
    if (error != std::errc{} || last != text.data() + end) return false;
    out.push_back(v);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return true;
}

/// Takes the points of the journal at `path` into `known`.
JournalVisitor Into(std::map<std::string, Evaluation>& known, const Study& study,
                    const std::string& path) {
  const auto header = [&study, path](std::string_view text) {
    if (!text.starts_with(fmt::format("ambrig study 1\t{}\t", study.fingerprint)))
      throw InputError(
          fmt::format("{}: holds another study, or this one before it, a rig or a scenario was "
                      "changed; allowed: the same files, or another folder with -o",
                      path));
  };
  const auto entry = [&known, &study](const JournalEntry& line) {
    const std::size_t a = line.text.find('\t'),
                      b = a == std::string_view::npos ? a : line.text.find('\t', a + 1);
    Evaluation e;
    if (b == std::string_view::npos ||
        !ParseNumbers(line.text.substr(a + 1, b - a - 1), e.figures) ||
        e.figures.size() != study.figures.size())
      return false;
    e.note = line.text.substr(b + 1);
    known[std::string(line.text.substr(0, a))] = e;
    return true;
  };
  return {header, entry};
}

}  // namespace

StudyJournal::StudyJournal(const std::string& folder, const Study& study)
    : journal_(PathOf(folder), fmt::format("ambrig study 1\t{}\t{}", study.fingerprint, study.file),
               Into(known_, study, PathOf(folder))) {}

std::optional<Evaluation> StudyJournal::Find(std::size_t candidate,
                                             const std::vector<double>& values) const {
  const std::scoped_lock lock(mutex_);
  const auto it = known_.find(Key(candidate, values));
  return it == known_.end() ? std::nullopt : std::optional(it->second);
}

void StudyJournal::Add(std::size_t candidate, const std::vector<double>& values,
                       const Evaluation& e) {
  const std::string key = Key(candidate, values);
  const std::scoped_lock lock(mutex_);
  if (known_.contains(key)) return;
  journal_.Append(fmt::format("{}\t{}\t{}", key, Numbers(e.figures), e.note));
  known_[key] = e;
}

std::size_t StudyJournal::size() const {
  const std::scoped_lock lock(mutex_);
  return known_.size();
}

}  // namespace ambrig
