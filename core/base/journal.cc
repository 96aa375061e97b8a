#include "core/base/journal.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <fstream>

#include "core/base/errors.h"
#include "core/base/fingerprint.h"

namespace ambrig {

namespace {

constexpr std::size_t kCheckDigits = 16;

struct Head {
  std::string_view text;
  std::uint64_t check = 0;
  std::size_t bytes = 0;
};

template <class T>
bool ParseAll(std::string_view text, T& value, int base) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return error == std::errc{} && end == text.data() + text.size();
}

/// The parts of a line; false when it is none of a journal.
bool ParseJournalHead(std::string_view line, Head& head) {
  const std::size_t tab = line.rfind('\t');
  if (tab == std::string_view::npos) return false;
  head.text = line.substr(0, tab);
  const std::string_view check = line.substr(tab + 1, kCheckDigits);
  const std::string_view bytes = line.substr(tab + 1 + check.size());
  if (check.size() != kCheckDigits || !ParseAll(check, head.check, 16)) return false;
  return bytes.empty() || (bytes[0] == '+' && ParseAll(bytes.substr(1), head.bytes, 10));
}

std::uint64_t CheckOf(std::string_view text, std::string_view data) {
  return Fingerprint(data, Fingerprint(text));
}

std::string Written(std::string_view text, std::string_view data) {
  std::string out = fmt::format("{}\t{:016x}", text, CheckOf(text, data));
  if (!data.empty()) out += fmt::format("+{}", data.size());
  out += '\n';
  if (data.empty()) return out;
  out += data;
  return out += '\n';
}

class JournalReader {
 public:
  explicit JournalReader(const std::string& path) {
    std::error_code error;
    size_ = static_cast<std::size_t>(std::filesystem::file_size(path, error));
    if (!error) in_.open(path, std::ios::binary);  // only a file: a pipe would wait for its writer
    if (error || !in_) throw InputError(path + ": cannot be read");
  }

  bool NextLine() {
    line_end_ = at_;
    if (!std::getline(in_, line_)) return false;
    ++number_;
    whole_ = !in_.eof();
    line_end_ = at_ += line_.size() + (whole_ ? 1 : 0);
    return true;
  }

  /// The entry of the present line and its data; false, and behind the line again, when its check
  /// sum does not fit.
  bool Entry(JournalEntry& entry, bool& has_data) {
    Head head;
    has_data = false;
    if (!whole_ || !ParseJournalHead(line_, head)) return false;
    has_data = head.bytes > 0;
    if (head.bytes > size_ - std::min(size_, at_)) return false;
    data_.resize(head.bytes);
    if (has_data) in_.read(data_.data(), static_cast<std::streamsize>(head.bytes));
    const bool ended = !has_data || in_.get() == '\n';
    if (!in_ || !ended || CheckOf(head.text, data_) != head.check) {
      in_.clear();
      in_.seekg(static_cast<std::streamoff>(line_end_));
      return false;
    }
    if (has_data) at_ += head.bytes + 1;
    entry = {head.text, number_, line_end_, head.bytes};
    return true;
  }

 private:
  std::ifstream in_;
  std::string line_, data_;
  std::size_t size_ = 0, at_ = 0, line_end_ = 0, number_ = 0;  // [bytes], lines
  bool whole_ = false;
};

}  // namespace

std::size_t ReadJournalFile(const std::string& path, const JournalVisitor& visit) {
  JournalReader reader(path);
  JournalEntry entry;
  bool has_data = false;
  visit.header(reader.NextLine() && reader.Entry(entry, has_data) ? entry.text
                                                                  : std::string_view{});
  std::size_t damaged = 0;
  bool in_data = false;  // lines that are the data of an entry that is damaged
  while (reader.NextLine()) {
    const bool sound = reader.Entry(entry, has_data);
    if ((!sound && !in_data) || (sound && !visit.entry(entry))) ++damaged;
    in_data = !sound && (in_data || has_data);
  }
  return damaged;
}

Journal::Journal(const std::string& path, const std::string& header, const JournalVisitor& visit)
    : file_(path) {
  Require(header.find('\n') == std::string::npos, "a header of one line");
  std::string first;
  std::getline(std::ifstream(path, std::ios::binary), first);
  end_ = static_cast<std::size_t>(std::filesystem::file_size(path));
  if (end_ <= first.size()) {  // without a whole first line nothing was recorded yet
    if (!Written(header, "").starts_with(first))
      throw InputError(path + " exists and is not an output of ambrig, allowed: another name");
    file_.Truncate(0);
    end_ = 0;
    Append(header);
    return;
  }
  damaged_ = ReadJournalFile(path, visit);
  // A half entry is ended, so that the next one stands alone.
  char last = 0;
  if (!file_.ReadAt(end_ - 1, &last, 1) || last != '\n') {
    file_.Append("\n");
    ++end_;
  }
}

std::size_t Journal::Append(std::string_view text, std::string_view data) {
  Require(text.find('\n') == std::string_view::npos, "an entry of one line");
  const std::string bytes = Written(text, data);
  const std::scoped_lock lock(mutex_);
  file_.Append(bytes);
  end_ += bytes.size();
  return end_ - (data.empty() ? 0 : data.size() + 1);
}

}  // namespace ambrig
