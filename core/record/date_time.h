#pragma once
/// Dates and times of day as loggers write them in a time column.
#include <cstdint>
#include <optional>
#include <string_view>

namespace ambrig {

/// An instant, split so that fractions keep their digits beside a year of seconds.
struct DateTime {
  bool has_date = false, has_time = false;
  std::int64_t seconds = 0;  // since 1970-01-01 00:00 UTC, or of the day without a date
  double fraction = 0;       // [s], 0 to 1
};

/// ISO 8601 "2024-05-01T12:00:00.25Z" (also a blank for T, a decimal comma, an offset +02:00),
/// "2024/05/01 ...", "01.05.2024 ...", a date alone, a time of day alone "12:00:00.25" or "12:00".
/// nullopt for any other text, and for days that no calendar has.
std::optional<DateTime> ParseDateTime(std::string_view text);

/// later - earlier [s]
double SecondsBetween(const DateTime& earlier, const DateTime& later);

}  // namespace ambrig
