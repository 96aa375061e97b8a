#include "app/text/screen.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/text/format.h"

namespace ambrig {
namespace {

constexpr std::string_view kMendMark =
    "to mend it: ";  // of FaultText, before a line of the case file

void ReplaceAll(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// Where the description of an option's line begins: after the first run of spaces behind its name.
std::size_t DescriptionColumn(std::string_view line) {
  const std::size_t name = line.find_first_not_of(' ');
  if (name == std::string_view::npos || name == 0) return 0;
  if (name > 20) return name;  // a description below a long name
  const std::size_t gap = line.find("  ", name);
  const std::size_t description =
      gap == std::string_view::npos ? gap : line.find_first_not_of(' ', gap);
  return description == std::string_view::npos || description > kScreenColumns / 2 ? name + 2
                                                                                   : description;
}

}  // namespace

std::size_t ScreenWidth(std::string_view text) {
  std::size_t width = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '\033') {
      k = std::min(text.find('m', k), text.size());
      continue;
    }
    width += (static_cast<unsigned char>(text[k]) & 0xC0) == 0x80 ? 0 : 1;
  }
  return width;
}

std::string Wrapped(std::string_view given, std::size_t indent, std::size_t columns) {
  // a line to paste is not broken
  if (const std::size_t mend = given.find(kMendMark); mend != std::string_view::npos && mend > 0)
    return Wrapped(given.substr(0, mend), indent, columns) + '\n' + std::string(indent, ' ') +
           std::string(given.substr(mend));
  std::string text(given);
  std::ranges::replace(text, '\n', ' ');
  std::string out;
  std::size_t used = 0;
  bool first_word = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = std::min(text.find_first_not_of(' ', at), text.size());
    std::size_t end = std::min(text.find(' ', begin), text.size());
    if (text.compare(end, 2, " %") == 0) end = std::min(text.find(' ', end + 1), text.size());
    const std::string_view word = std::string_view(text).substr(begin, end - begin);
    const std::string_view gap = std::string_view(text).substr(at, begin - at);
    if (word.empty()) break;
    if (!first_word && used + gap.size() + ScreenWidth(word) > columns) {
      out += '\n' + std::string(indent, ' ');
      used = indent;
    } else {
      out += gap;
      used += gap.size();
    }
    out += word;
    used += ScreenWidth(word);
    first_word = false;
    at = end;
  }
  return out;
}

std::string Shortened(std::string_view text, std::size_t columns) {
  if (ScreenWidth(text) <= columns) return std::string(text);
  std::string out;
  for (std::size_t k = 0, width = 0; k < text.size(); ++k) {
    width += (static_cast<unsigned char>(text[k]) & 0xC0) == 0x80 ? 0 : 1;
    if (width + 3 > columns) break;
    out += text[k];
  }
  return out + "...";
}

std::string TerminalText(std::string text) {
  for (const auto& [from, to] : {std::pair("\u00a0", " "), {"\u202f", ""}, {"µ", "u"}, {"−", "-"}})
    ReplaceAll(text, from, to);
  return text;
}

std::string ScreenSi(double value, std::string_view unit, int digits) {
  return std::isfinite(value) ? TerminalText(FormatSi(value, unit, digits)) : "-";
}

std::string WrappedHelp(std::string_view text, std::size_t columns) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    if (ScreenWidth(line) <= columns || line.starts_with("  ambrig "))
      out += line;
    else
      out += Wrapped(line, DescriptionColumn(line), columns);
    if (end < text.size()) out += '\n';
    at = end + 1;
  }
  return out;
}

std::string PrintableLine(const std::string& text) {
  constexpr std::size_t kLongest = 1000;
  std::string line = text.size() > kLongest ? text.substr(0, kLongest) + " ..." : text;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
  return line;
}

}  // namespace ambrig
