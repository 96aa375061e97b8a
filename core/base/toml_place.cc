#include "core/base/toml_place.h"

#include <algorithm>

namespace ambrig {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace

TomlPlaces::TomlPlaces(const std::string& text) : text_(text) {
  lines_.push_back(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
  for (std::size_t k = 0; k < text.size(); ++k)
    if (text[k] == '\n') lines_.push_back(k + 1);
}

/// toml++ counts columns in characters, of which UTF-8 has up to four bytes each.
std::size_t TomlPlaces::Offset(const toml::source_position& position) const {
  std::size_t at = lines_[std::min<std::size_t>(position.line, lines_.size()) - 1];
  for (auto column = position.column; column > 1 && at < text_.size(); --column) do {
      ++at;
    } while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xc0u) == 0x80u);
  return at;
}

TomlSpan TomlPlaces::Of(const toml::node& node) const {
  const toml::source_region& source = node.source();
  TomlSpan span{Offset(source.begin), Offset(source.end)};
  while (span.end > span.begin + 1 &&
         std::string_view(" \t\r\n").find(text_[span.end - 1]) != std::string_view::npos)
    --span.end;
  return span;
}

std::size_t TomlPlaces::LineBegin(std::size_t at) const {
  const auto next = std::upper_bound(lines_.begin(), lines_.end(), at);
  return next == lines_.begin() ? lines_.front() : *(next - 1);
}

std::size_t TomlPlaces::NextLine(std::size_t at) const {
  const auto next = std::upper_bound(lines_.begin(), lines_.end(), at);
  return next == lines_.end() ? text_.size() : *next;
}

std::string TomlPlaces::Indentation(std::size_t at) const {
  const std::size_t begin = LineBegin(at),
                    first = std::min(text_.find_first_not_of(" \t", begin), text_.size());
  return text_.substr(begin, first - begin);
}

bool TomlPlaces::HasHeader(const toml::node& node) const {
  if (const toml::array* a = node.as_array())
    return !a->empty() && a->get(0)->is_table() && !a->get(0)->as_table()->is_inline();
  return node.is_table() && !node.as_table()->is_inline() && text_[Of(node).begin] == '[';
}

TomlSpan TomlPlaces::LastValue(const toml::table& table, TomlSpan last) const {
  for (auto&& [key, child] : table) {
    if (HasHeader(child)) continue;
    const toml::table* dotted = child.as_table();
    if (dotted && !dotted->is_inline())
      last = LastValue(*dotted, last);
    else if (const TomlSpan span = Of(child); span.end > last.end)
      last = span;
  }
  return last;
}

std::size_t TomlPlaces::Top() const {
  std::size_t at = lines_.front();
  while (at < text_.size() && text_[at] == '#') at = NextLine(at);
  const bool blank = at < text_.size() && (text_[at] == '\n' || text_[at] == '\r');
  return blank ? at : lines_.front();  // else it is the comment of the first table
}

std::vector<TomlSpan> TomlPlaces::Blocks(const toml::node& node) const {
  std::vector<TomlSpan> out;
  if (const toml::array* a = node.as_array())
    for (const toml::node& child : *a)
      for (const TomlSpan& span : Blocks(child)) out.push_back(span);
  const toml::table* table = node.as_table();
  if (!table || !HasHeader(node)) return out;
  out.push_back({LineBegin(Of(node).begin), NextLine(LastOf(*table).end - 1)});
  for (auto&& [key, child] : *table)
    if (HasHeader(child))
      for (const TomlSpan& span : Blocks(child)) out.push_back(span);
  return out;
}

}  // namespace ambrig
