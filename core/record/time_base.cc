#include "core/record/time_base.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/errors.h"
#include "core/base/parameters.h"
#include "core/record/column_names.h"
#include "core/record/text_cells.h"
#include "core/record/time_gaps.h"
#include "core/record/units.h"

namespace ambrig {

namespace {

/// "Time (ms)" -> "time", "ms"; the second is empty when the name holds no unit of time.
std::pair<std::string, std::string> SplitTimeName(std::string_view name) {
  std::string text;
  for (const char c : name)
    if (c != ' ') text += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  for (const std::string unit : {"ms", "us", "ns", "s"})
    for (const std::string& tail : {"_" + unit, "(" + unit + ")"})
      if (text.size() > tail.size() && text.ends_with(tail))
        return {text.substr(0, text.size() - tail.size()), unit};
  return {text, ""};
}

}  // namespace

bool IsTimeName(std::string_view name) {
  const std::string base = SplitTimeName(name).first;
  return base == "t" || base == "time";
}

std::string TimeUnitOf(std::string_view name) { return SplitTimeName(name).second; }

TimeBase UniformTimeBase(const std::vector<double>& t, const std::string& where,
                         std::size_t header_rows, double tolerance) {
  if (t.size() < 2) throw InputError(where + ": a time column needs at least two rows");
  const double period = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  const auto fail = [&](std::size_t k, const std::string& what) {
    throw InputError(where + ": row " + std::to_string(k + 1 + header_rows) + ": time " +
                     NumberText(t[k]) + " s " + what);
  };
  for (std::size_t k = 0; k < t.size(); ++k)
    if (!std::isfinite(t[k])) fail(k, "is not a number");
  for (std::size_t k = 1; k < t.size(); ++k)
    if (!(t[k] > t[k - 1])) fail(k, "does not increase");
  // Distances, not positions, so that the first row named is where the gap is.
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double first = t[1] - t[0], step = t[k] - t[k - 1];
    if (std::abs(step - first) > 2 * tolerance * std::min(first, period))
      fail(k, fmt::format("is not uniform: step {:.9g} s, expected {:.9g} s", step, first));
  }
  for (std::size_t k = 0; k < t.size(); ++k)
    if (std::abs(t[k] - t.front() - static_cast<double>(k) * period) > tolerance * period)
      fail(k, "is not uniform: expected " +
                  NumberText(t.front() + static_cast<double>(k) * period) + " s");
  // A rate that was a short number before its period was rounded in the file comes back as such.
  const double rate = 1 / period, rounded = std::round(rate * 1e3) / 1e3;
  const double resolution = 4e-16 * std::max(std::abs(t.front()), std::abs(t.back()));
  const bool same = std::abs(rounded - rate) <= rate * (1e-9 + resolution / (t.back() - t.front()));
  return {same ? rounded : rate, t.front()};
}

namespace {

void TakeTimeChannel(Record& record, const std::string& where, std::size_t header_rows) {
  const auto is_time = [](const Channel& c) { return IsTimeName(c.name); };
  const auto it = std::find_if(record.channels.begin(), record.channels.end(), is_time);
  if (it == record.channels.end()) return;
  Channel time = std::move(*it);
  record.channels.erase(it);
  const std::string unit = time.unit.empty() ? TimeUnitOf(time.name) : time.unit;
  if (!unit.empty()) {
    const double factor = UnitFactor(unit, "s", where + ": " + time.name);
    for (double& t : time.samples) t *= factor;
  }
  if (record.rate != 0 && time.samples.size() < 2) return;
  if (record.rate == 0) FillGaps(record, time.samples);
  const TimeBase base = UniformTimeBase(time.samples, where + ": column " + time.name, header_rows);
  if (record.rate == 0) {
    record.rate = base.rate;
    record.start = base.start;
  } else if (std::abs(base.rate - record.rate) > 1e-3 * std::abs(record.rate)) {
    throw InputError(where + ": rate = " + NumberText(record.rate) + " Hz, but " + time.name +
                     " has " + NumberText(base.rate) + " Hz");
  }
}

void CheckLengths(const Record& record, const std::string& where) {
  std::set<std::string> names;
  for (const Channel& c : record.channels) {
    if (!names.insert(c.name).second)
      throw InputError(where + ": channel " + c.name + " is there twice");
    if (c.samples.size() == record.rows()) continue;
    throw InputError(where + ": channel " + c.name + " has " + std::to_string(c.samples.size()) +
                     " rows, " + record.channels.front().name + " has " +
                     std::to_string(record.rows()));
  }
}

}  // namespace

void CheckRecord(const Record& record, const std::string& where) {
  if (record.channels.empty()) throw InputError(where + ": no channels");
  CheckLengths(record, where);
  if (record.rate == 0)
    throw InputError(where + ": neither a rate [Hz] nor a time channel, allowed: " + kTimeNames +
                     "; there are: " + ColumnsOf(record, "time"));
  if (!(record.rate > 0) || !std::isfinite(record.rate))
    throw InputError(where + ": rate = " + NumberText(record.rate) + " Hz, must be positive");
  if (!std::isfinite(record.start))
    throw InputError(where + ": start = " + NumberText(record.start) + " s, must be finite");
}

void FinishRecord(Record& record, const std::string& where, std::size_t header_rows) {
  for (Channel& c : record.channels) {
    c.name = Utf8(c.name);
    c.unit = Utf8(c.unit);
  }
  for (std::string& note : record.notes) note = Utf8(note);
  CheckLengths(record, where);
  TakeTimeChannel(record, where, header_rows);
  CheckRecord(record, where);
}

}  // namespace ambrig
