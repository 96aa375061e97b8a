#include "core/record/date_time.h"

#include <algorithm>
#include <chrono>

#include "core/record/text_cells.h"

namespace ambrig {

namespace {

/// What is left of a text that is read from its beginning.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool done() const { return rest_.empty(); }
  bool Take(std::string_view any_of) {
    if (rest_.empty() || any_of.find(rest_[0]) == std::string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// A number of exactly or at most `digits` digits; -1 when there is none.
  int Number(std::size_t least, std::size_t most) {
    std::size_t n = 0;
    int value = 0;
    for (; n < std::min(most, rest_.size()) && IsDigit(rest_[n]); ++n)
      value = value * 10 + (rest_[n] - '0');
    if (n < least) return -1;
    rest_.remove_prefix(n);
    return value;
  }
  /// Digits behind the decimal point as a fraction; -1 when there is none.
  double Fraction() {
    std::size_t n = 0;
    double value = 0, unit = 1;
    for (; n < rest_.size() && IsDigit(rest_[n]); ++n)
      if (n < 18) {
        value = value * 10 + (rest_[n] - '0');
        unit *= 10;
      }
    rest_.remove_prefix(n);
    return n == 0 ? -1 : value / unit;
  }

 private:
  static bool IsDigit(char c) { return c >= '0' && c <= '9'; }
  std::string_view rest_;
};

bool TakeDate(Scanner& s, DateTime& out) {
  const Scanner before = s;
  int year = s.Number(4, 4), month = -1, day = -1;
  if (year >= 0) {
    if (!s.Take("-/.")) return s = before, false;
    month = s.Number(1, 2);
    if (!s.Take("-/.")) return s = before, false;
    day = s.Number(1, 2);
  } else {
    day = s.Number(1, 2);
    if (!s.Take(".")) return s = before, false;
    month = s.Number(1, 2);
    if (!s.Take(".")) return s = before, false;
    year = s.Number(4, 4);
  }
  const std::chrono::year_month_day date(std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day)));
  if (year < 0 || month < 0 || day < 0 || !date.ok()) return s = before, false;
  out.seconds += 86400LL * std::chrono::sys_days(date).time_since_epoch().count();
  return out.has_date = true;
}

bool TakeTime(Scanner& s, DateTime& out) {
  const int hour = s.Number(1, 2);
  if (hour < 0 || hour > 23 || !s.Take(":")) return false;
  const int minute = s.Number(2, 2);
  if (minute < 0 || minute > 59) return false;
  int second = 0;
  if (s.Take(":")) {
    second = s.Number(2, 2);
    if (second < 0 || second > 60) return false;  // 60: a leap second
    if (s.Take(".,") && (out.fraction = s.Fraction()) < 0) return false;
  }
  out.seconds += 3600 * hour + 60 * minute + second;
  return out.has_time = true;
}

/// Z, +02:00, +0200, -05; the offset is taken off.
bool TakeZone(Scanner& s, DateTime& out) {
  if (s.done() || s.Take("Zz")) return true;
  const bool east = s.Take("+");
  if (!east && !s.Take("-")) return false;
  const int hour = s.Number(2, 2);
  s.Take(":");
  const int minute = s.done() ? 0 : s.Number(2, 2);
  if (hour < 0 || minute < 0) return false;
  out.seconds -= (east ? 1 : -1) * (3600 * hour + 60 * minute);
  return true;
}

}  // namespace

std::optional<DateTime> ParseDateTime(std::string_view text) {
  Scanner s(Trim(text));
  DateTime out;
  const bool date = TakeDate(s, out);
  if (date && s.done()) return out;
  if (date && !s.Take("T ")) return std::nullopt;
  if (!TakeTime(s, out) || !TakeZone(s, out) || !s.done()) return std::nullopt;
  return out;
}

double SecondsBetween(const DateTime& earlier, const DateTime& later) {
  return static_cast<double>(later.seconds - earlier.seconds) + (later.fraction - earlier.fraction);
}

}  // namespace ambrig
