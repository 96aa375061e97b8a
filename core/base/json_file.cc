#include "core/base/json_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.h"
#include "core/base/read_file.h"

namespace ambrig {

namespace {
constexpr int kMostInside = 100;  // copies and texts of JSON are recursive
}

nlohmann::json ReadJson(const std::string& file) {
  const std::string text = ReadFile(file);
  try {
    return nlohmann::json::parse(
        text, [&](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
          if (depth > kMostInside)
            throw InputError(
                fmt::format("{}: values more than {} deep inside one another", file, kMostInside));
          return true;
        });
  } catch (const nlohmann::json::parse_error& e) {
    const std::size_t at = std::min(e.byte > 0 ? e.byte - 1 : 0, text.size());
    const std::string before = text.substr(0, at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column = at - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
    throw InputError(fmt::format("{}:{}:{}: not valid JSON{}", file, line, column,
                                 at == text.size() ? ": it ends too early" : ""));
  } catch (const nlohmann::json::exception&) {
    throw InputError(fmt::format("{}: holds a number beyond the range of a double", file));
  }
}

}  // namespace ambrig
