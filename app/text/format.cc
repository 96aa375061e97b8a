#include "app/text/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "core/math/constants.h"

namespace ambrig {
namespace {

constexpr std::string_view kNoPrefix[] = {"", "-", "%", "deg", "rpm", "1", "K", "degC", "periods"};

// Groups of three in the whole part; four digits alone stay together, as in print.
std::string Grouped(std::string text) {
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  const std::size_t point = std::min(text.find('.'), text.size());
  if (text.find('e') != std::string::npos || point - first <= 4) return text;
  for (std::size_t at = point; at > first + 3;) {
    at -= 3;
    text.insert(at, "\u202f");
  }
  return text;
}

std::string PlainNumber(double value, int digits) {
  const double size = std::abs(value);
  if (value == 0) return "0";
  if (size < 1e-4 || size >= 1e7) return fmt::format("{:.{}g}", value, digits);
  const int whole = static_cast<int>(std::floor(std::log10(size))) + 1;
  std::string text = fmt::format("{:.{}f}", value, std::max(0, digits - whole));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
  }
  return Grouped(text);
}

}  // namespace

std::string FormatNumber(double value, int digits) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  return PlainNumber(value, digits);
}

std::string FormatSi(double value, std::string_view unit, int digits) {
  const bool plain = std::ranges::find(kNoPrefix, unit) != std::end(kNoPrefix);
  const bool shown = !unit.empty() && unit != "-" && unit != "1" && !std::isnan(value);
  const std::string gap = shown ? "\u00a0" : "";
  if (plain || value == 0 || !std::isfinite(value))
    return FormatNumber(value, digits) + gap + (shown ? std::string(unit) : "");
  static constexpr std::array<std::string_view, 9> kPrefix = {"p", "n", "µ", "m", "",
                                                              "k", "M", "G", "T"};
  // Rounded first, so that 999.96e-6 becomes 1 mm and not 1000 um.
  const double rounded = std::strtod(fmt::format("{:.{}e}", value, digits - 1).c_str(), nullptr);
  const double own = std::floor(std::log10(std::abs(rounded)) / 3),
               group = std::clamp(own, -4.0, 4.0);
  if (std::abs(own) > 5)  // far beyond the prefixes
    return fmt::format("{:.{}g}", value, digits) + gap + std::string(unit);
  return PlainNumber(rounded / std::pow(10.0, 3 * group), digits) + gap +
         std::string(kPrefix[static_cast<std::size_t>(group + 4)]) + std::string(unit);
}

std::string FalseAlarmText(double alarms, double coil_periods) {
  if (!(coil_periods > 0)) return "not watched";
  return fmt::format("{:.0f} in {:.3g} switching periods of healthy coils", alarms, coil_periods);
}

std::string Rpm(double speed) { return fmt::format("{:.0f} rpm", speed * 30 / kPi); }

std::string SpeedRange(double lowest, double highest) {
  return lowest < highest ? fmt::format("{:.0f} to {}", lowest * 30 / kPi, Rpm(highest))
                          : "at " + Rpm(highest);
}

std::string HtmlEscape(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string InlineMarkup(std::string_view text) {
  std::string out = HtmlEscape(text);
  const auto wrap = [&out](std::string_view mark, std::string_view tag) {
    std::size_t at = 0;
    while ((at = out.find(mark, at)) != std::string::npos) {
      const std::size_t end = out.find(mark, at + mark.size());
      if (end == std::string::npos) return;
      // "2 * 3 * 4" is arithmetic: a mark opens only before and closes only after a word.
      const bool opens =
          out[at + mark.size()] != ' ' && out[end - 1] != ' ' && end > at + mark.size();
      if (!opens) {
        at += mark.size();
        continue;
      }
      const std::string inner = out.substr(at + mark.size(), end - at - mark.size());
      const std::string made = fmt::format("<{0}>{1}</{0}>", tag, inner);
      out.replace(at, end + mark.size() - at, made);
      at += made.size();
    }
  };
  wrap("`", "code");
  wrap("**", "strong");
  wrap("*", "em");
  return out;
}

}  // namespace ambrig
