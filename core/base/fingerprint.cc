#include "core/base/fingerprint.h"

#include <fmt/format.h>

namespace ambrig {

std::string CheckedLine(const std::string& text) {
  return fmt::format("{}\t{:016x}\n", text, Fingerprint(text));
}

std::string_view Unchecked(std::string_view line) {
  const std::size_t tab = line.rfind('\t');
  if (tab == std::string_view::npos ||
      fmt::format("{:016x}", Fingerprint(line.substr(0, tab))) != line.substr(tab + 1))
    return {};
  return line.substr(0, tab);
}

}  // namespace ambrig
