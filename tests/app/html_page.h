#pragma once
/// A page as text: read back from where a report was written, and its cells without markup.
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "tests/core/temporary_folder.h"

namespace ambrig::testing {

/// What `write` puts into the file that it is given.
inline std::string Written(const std::function<void(const std::string&)>& write) {
  const TemporaryFolder folder;
  write(folder.File("page.html"));
  return ReadBytes(folder.File("page.html"));
}

/// The page without scripts and styles: markup and words of our own.
inline std::string OwnMarkup(const std::string& html) {
  std::string out;
  std::size_t at = 0;
  while (true) {
    const std::size_t script = html.find("<script", at), style = html.find("<style", at),
                      begin = std::min(script, style);
    if (begin == std::string::npos) return out + html.substr(at);
    out += html.substr(at, begin - at);
    at = html.find(begin == script ? "</script>" : "</style>", begin);
    if (at == std::string::npos) return out;
  }
}

/// The words of a page, one line per cell or paragraph.
inline std::string Words(const std::string& html) {
  std::string out;
  bool tag = false;
  for (const char c : OwnMarkup(html)) {
    if (c == '<' && !tag && !out.empty() && out.back() != '\n') out += '\n';
    if (c == '<') tag = true;
    if (!tag) out += c;
    if (c == '>') tag = false;
  }
  return out;
}

inline std::size_t CountOf(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

}  // namespace ambrig::testing
