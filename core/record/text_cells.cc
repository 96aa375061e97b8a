#include "core/record/text_cells.h"

#include <algorithm>
#include <charconv>

namespace ambrig {

std::string_view Trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string_view Unquote(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? Trim(text.substr(1, text.size() - 2)) : text;
}

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  return lower;
}

namespace {

/// Length of the UTF-8 character at `at`, 0 when there is none.
std::size_t Utf8Length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned first = byte(at);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || at + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(at + k) & 0xc0) != 0x80) return 0;
  const unsigned second = byte(at + 1);
  const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool beyond = (first == 0xed && second > 0x9f) || (first == 0xf4 && second > 0x8f);
  return overlong || beyond ? 0 : length;
}

}  // namespace

std::string Utf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t length = Utf8Length(text, at);
    if (length == 0) break;
    at += length;
  }
  if (at == text.size()) return std::string(text);
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80)
      out += c;
    else
      out += {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
  }
  return out;
}

bool ToNumber(std::string_view cell, double& value) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  const auto whole = [&value](std::string_view text) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
  };
  const std::size_t comma = cell.find(',');
  if (comma == std::string_view::npos) return whole(cell);
  std::string point(cell);
  point[comma] = '.';
  return whole(point);
}

bool Lines::Next() {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++number_;
  return true;
}

bool Cells::Next() {
  if (next_ > line_.size()) return false;
  begin_ = next_;
  std::size_t from = line_.find_first_not_of(" \r", begin_);
  from = from != std::string_view::npos && line_[from] == '"' ? line_.find('"', from + 1) : begin_;
  // A quote that is never closed is text like any other.
  if (from == std::string_view::npos) from = begin_;
  const std::size_t end = std::min(line_.find(separator_, from), line_.size());
  cell_ = line_.substr(begin_, end - begin_);
  next_ = end + 1;
  return true;
}

std::size_t Cells::column() const {
  const std::size_t blanks = cell_.find_first_not_of(" \t\r");
  return begin_ + 1 + (blanks == std::string_view::npos ? 0 : blanks);
}

}  // namespace ambrig
