#include "core/base/parameters.h"

#include <fmt/format.h>

namespace ambrig {

std::string NumberText(double value) { return fmt::format("{}", value); }

void ThrowOutOfRange(std::string_view where, std::string_view, double value, std::string_view unit,
                     double lo, double hi, std::string_view doc) {
  const std::string u = unit == "-" ? "" : fmt::format(" {}", unit);
  const std::string what = std::isnan(value) ? ": is missing" : fmt::format(" = {}{}", value, u);
  throw InputError(fmt::format("{}{}, allowed {} to {}{} ({})", where, what, lo, hi, u, doc));
}

}  // namespace ambrig
