// Values that cannot be, that stand still, or that end at a limit which the model exceeds.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/record/channels.h"
#include "discovery/data/held_values.h"
#include "discovery/data/noise_estimate.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_columns.h"
#include "discovery/data_gate/gate_set_points.h"

namespace ambrig {

namespace {

constexpr double kAbsurd = 4;          // times the largest value that a channel can show
constexpr double kFewAbsurd = 0.05;    // of the rows; more: the column's unit is wrong
constexpr std::size_t kClipRun = 4;    // equal neighbours at the extreme
constexpr std::size_t kCoarse = 3;     // readings that a converter repeats usually
constexpr double kClipShare = 0.005;   // of the rows
constexpr double kWithinShare = 0.25;  // of the rows of a stretch that no limit explains

const Channel& ChannelOf(const CaseRecord& r, const std::string& name) {
  return *r.data.Find(name);
}

/// Rows that stand apart from the rows on both sides by more than `farthest`.
std::vector<std::size_t> LonelyRows(const std::vector<double>& y, double farthest) {
  std::vector<std::size_t> out;
  for (std::size_t k = 2; k + 2 < y.size(); ++k) {
    std::array<double, 4> beside{y[k - 2], y[k - 1], y[k + 1], y[k + 2]};
    std::ranges::sort(beside);
    if (std::max(y[k] - beside[3], beside[0] - y[k]) > farthest) out.push_back(k);
  }
  return out;
}

/// How far a column may come and go within one row at most; infinity where that is not known.
double FarthestOf(const CaseModel& model, const CaseRecord& r, const GateColumn& c) {
  constexpr double kFastest = 5;    // [m/s]: a shaft that falls into its stops is slower
  constexpr double kOfRange = 0.5;  // of a converter's range
  constexpr double kNoise = 50;     // times the noise
  double possible = kInfinity;
  if (IsOfKind(c.name, ChannelKind::kReading)) possible = kFastest / r.data.rate;
  if (IsOfKind(c.name, ChannelKind::kCoilCurrent))
    possible = kOfRange * model.data().rig.amplifier.adc_range;
  if (!std::isfinite(possible)) return possible;
  const double noise = WhiteNoiseOf(c.column.measured.data(), c.column.ok.data(), c.column.size());
  return std::max(possible, kNoise * c.floor * std::max(1.0, noise));
}

/// Rows whose values cannot be, where they are few: they are told, and later checks leave them out.
void TellRange(const CaseRecord& r, GateColumn& c, const std::vector<std::size_t>& rows,
               std::vector<DataFault>& out) {
  const auto count = static_cast<double>(rows.size());
  if (rows.empty() || count > kFewAbsurd * static_cast<double>(c.column.size())) return;
  for (const std::size_t k : rows) c.column.ok[k] = 0, c.column.measured[k] = 0;
  c.match = MatchOf(c.column);
  DataFault f;
  f.record = r.data_file;
  f.channel = c.name;
  f.fault = "range";
  f.seconds = count / r.data.rate;
  f.mend = LeaveOutLine(r, rows.front(), 1);
  f.probability = 0.999;
  out.push_back(f);
}

}  // namespace

void CheckRange(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  for (GateColumn& c : columns) {
    const double limit = kAbsurd * LimitOf(model.data().rig, c.name) / c.floor;
    const double usual = kAbsurd * 50 * (c.match.predicted_rms + 1);
    const double most = std::isfinite(limit) ? limit : usual;
    std::vector<std::size_t> beyond;
    for (std::size_t k = 0; k < c.column.size(); ++k)
      if (c.column.ok[k] && std::abs(c.column.measured[k]) > most) beyond.push_back(k);
    TellRange(r, c, beyond, out);
  }
}

void CheckSpikes(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                 std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  for (GateColumn& c : columns) {
    const std::vector<double>& y = ChannelOf(r, c.name).samples;
    const bool told = std::ranges::any_of(
        out, [&](const DataFault& f) { return f.record == r.data_file && f.channel == c.name; });
    const bool whole = std::ranges::all_of(y, [](double v) { return std::isfinite(v); });
    if (told || !whole || y.size() != c.column.size()) continue;
    const double farthest = FarthestOf(model, r, c);
    if (std::isfinite(farthest)) TellRange(r, c, LonelyRows(y, farthest), out);
  }
}

namespace {

/// The samples that are at neither extreme, in order.
std::vector<double> OffTheExtremes(const std::vector<double>& y, double low, double high) {
  std::vector<double> out;
  std::copy_if(y.begin(), y.end(), std::back_inserter(out),
               [&](double v) { return v != low && v != high; });
  return out;
}

/// Rows at the column's own extreme that the prediction passes by several floors; `hold`: rows of
/// one reading.
std::size_t ClippedRows(const GateColumn& c, const std::vector<double>& y, std::size_t hold,
                        double extreme, double sign) {
  std::size_t rows = 0;
  double beyond = 0;
  for (const HeldStretch& s : HeldStretches(y, kClipRun * hold)) {
    if (s.value != extreme) continue;
    rows += s.count;
    for (std::size_t k = s.first; k < s.first + s.count; ++k)
      beyond += sign * (c.column.predicted[k] - extreme / c.floor);
  }
  return rows > 0 && beyond > kBeyondFloors * static_cast<double>(rows) ? rows : 0;
}

/// Rows at the column's own extreme in stretches that no noise makes: of a column that never
/// repeats a value elsewhere, far from the converter's own limits.
std::size_t FlatTopRows(const CaseModel& model, const GateColumn& c, const std::vector<double>& y,
                        double low, double high) {
  constexpr std::size_t kRun = 8, kTimes = 3;
  constexpr double kShare = 0.01;  // of the rows
  const double limit = LimitOf(model.data().rig, c.name);
  if (UsualHold(OffTheExtremes(y, low, high)) > 1) return 0;
  std::size_t rows = 0, times = 0;
  for (const HeldStretch& s : HeldStretches(y, kRun))
    if ((s.value == high || s.value == low) && s.value != 0 && std::abs(s.value) < 0.95 * limit)
      rows += s.count, ++times;
  const double share = static_cast<double>(rows) / static_cast<double>(y.size());
  // one that stands there once may have frozen
  return times >= kTimes && share > kShare ? rows : 0;
}

/// Whether the prediction lies within the column's own extreme, at which it stands, by several
/// floors for a part of the stretch: a limit lets go of what comes back.
bool StandsWhileItComesBack(const GateColumn& c, const HeldStretch& s, double sign) {
  const auto within = static_cast<double>(std::count_if(
      c.column.predicted.begin() + static_cast<std::ptrdiff_t>(s.first),
      c.column.predicted.begin() + static_cast<std::ptrdiff_t>(s.first + s.count),
      [&](double predicted) { return sign * (s.value / c.floor - predicted) > kBeyondFloors; }));
  return within > kWithinShare * static_cast<double>(s.count);
}

}  // namespace

namespace {

/// Rows at a limit that the model exceeds, on both sides; `hold`: rows of one reading.
std::size_t RowsAtLimits(const CaseModel& model, const CaseRecord& r, const GateColumn& c,
                         const std::vector<double>& y, std::size_t hold) {
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  if (*low == *high) return 0;
  if (IsOfKind(c.name, ChannelKind::kSetPoint))
    return ClippedSetPointRows(model, r, c, y, *high) + ClippedSetPointRows(model, r, c, y, *low);
  return std::max(ClippedRows(c, y, hold, *high, 1) + ClippedRows(c, y, hold, *low, -1),
                  FlatTopRows(model, c, y, *low, *high));
}

void TellClipped(const CaseRecord& r, GateColumn& c, std::size_t rows,
                 std::vector<DataFault>& out) {
  DataFault f;
  f.record = r.data_file;
  f.channel = c.name;
  f.fault = "clip";
  f.seconds = static_cast<double>(rows) / r.data.rate;
  f.mend = fmt::format("channels.\"{}\".use = false", c.name);
  f.probability = 0.98;
  out.push_back(f);
  c.explained = true;
}

/// Limits and stretches that stand still; with `from_first_row` the stretches from there on alone,
/// which are not among the former.
void CheckStretches(const CaseModel& model, const CaseRecord& r, bool from_first_row,
                    std::vector<GateColumn>& columns, std::vector<DataFault>& out) {
  for (GateColumn& c : columns) {
    const bool set_point = IsOfKind(c.name, ChannelKind::kSetPoint);
    const std::vector<double>& y = ChannelOf(r, c.name).samples;
    // duties stand at their limits when the controller asks for more
    if (IsOfKind(c.name, ChannelKind::kDuty) || IsOfKind(c.name, ChannelKind::kSpeed) ||
        y.size() != c.column.size() || c.explained)
      continue;
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    // A record faster than the controller repeats every reading; a coarse converter repeats values
    // everywhere, also between the extremes.
    const std::size_t hold = RegularHold(y);
    if (UsualHold(OffTheExtremes(y, *low, *high)) > kCoarse * hold) continue;
    // limits have been looked at where stretches from the first row on are
    const std::size_t rows = from_first_row ? 0 : RowsAtLimits(model, r, c, y, hold);
    if (static_cast<double>(rows) > kClipShare * static_cast<double>(y.size())) {
      TellClipped(r, c, rows, out);
      continue;
    }
    if (r.scenario.start == StartState::kResting || UsualHold(y) > kCoarse * hold) continue;
    const HeldStretch s = FrozenStretch(y);
    if (s.count == 0 || (s.first == 0) != from_first_row) continue;
    if (set_point && (s.value == *low || s.value == *high || !SetPointFroze(r, c, s))) continue;
    const double extreme = s.value == *high ? 1 : s.value == *low ? -1 : 0;
    if (s.value != 0 && extreme != 0 && !StandsWhileItComesBack(c, s, extreme)) continue;
    TellHeld(r, c.name, s, out);
    c.explained = true;
  }
}

}  // namespace

void CheckHeld(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
               std::vector<DataFault>& out) {
  CheckStretches(model, model.data().records[record], false, columns, out);
}

void CheckHeldFromStart(const CaseModel& model, std::size_t record,
                        std::vector<GateColumn>& columns, std::vector<DataFault>& out) {
  CheckStretches(model, model.data().records[record], true, columns, out);
}

}  // namespace ambrig
