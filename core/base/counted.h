#pragma once
/// Counts in messages and reports: "1 scenario", "3 scenarios".
#include <fmt/format.h>

#include <string>
#include <string_view>

namespace ambrig {

/// `one`: the singular of a noun that takes an s; "entry" makes "entries".
template <class Number>
std::string Counted(Number n, std::string_view one) {
  if (n == Number{1}) return fmt::format("1 {}", one);
  if (one.ends_with('y')) return fmt::format("{} {}ies", n, one.substr(0, one.size() - 1));
  return fmt::format("{} {}s", n, one);
}

}  // namespace ambrig
