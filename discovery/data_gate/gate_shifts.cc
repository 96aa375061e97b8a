#include "discovery/data_gate/gate_shifts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/data_gate/gate_columns.h"

namespace ambrig {

namespace {

constexpr double kMostShift = 0.2;       // of the record
constexpr double kNoWorse = 0.05;        // of what a shift gains: a shift of all rows gains as much
constexpr double kEarly = 0.03;          // of the record: a shift from there on is one of all rows
constexpr std::size_t kGateRows = 6000;  // about: longer records are thinned

/// Every `step`-th row, movements scaled to 1, for a search over many shifts.
MatchedColumn ThinnedColumn(const GateColumn& c, std::size_t step) {
  MatchedColumn out;
  for (std::size_t k = 0; k < c.column.size(); k += step) {
    out.measured.push_back(c.column.measured[k] / c.match.predicted_move);
    out.predicted.push_back(c.column.predicted[k] / c.match.predicted_move);
    out.ok.push_back(c.column.ok[k]);
  }
  return out;
}

}  // namespace

FoundShift ShiftOf(const std::vector<const GateColumn*>& columns, double rate) {
  FoundShift f;
  if (columns.empty()) return f;
  const std::size_t rows = columns[0]->column.size();
  const std::size_t step = std::max<std::size_t>(1, rows / kGateRows);
  std::vector<MatchedColumn> thin;
  for (const GateColumn* c : columns) thin.push_back(ThinnedColumn(*c, step));
  const auto most = static_cast<long>(kMostShift * static_cast<double>(thin[0].size()));
  const Shift s = BestShift(thin, most);
  const double seconds = static_cast<double>(step) / rate;
  f.late = static_cast<double>(s.late) * seconds;
  f.from = static_cast<double>(s.from) * seconds;
  f.left = s.before > 0 ? s.after / s.before : 1;
  // rows before it in which nothing moves tell no instant
  f.all_rows = f.from <= kEarly * static_cast<double>(rows) / rate ||
               s.at_once < s.after + kNoWorse * (s.before - s.after);
  return f;
}

DataFault TimeFault(const CaseRecord& r, const std::string& channel, const FoundShift& s) {
  const double length = static_cast<double>(r.data.rows()) / r.data.rate;
  const bool lost = !s.all_rows && s.late < 0;
  DataFault f = FaultLeaving(r, channel, lost ? "lost" : "lag", s.left);
  f.seconds = lost ? -s.late : s.late;
  if (lost)
    f.mend = fmt::format("leave_out = [[{:.6g}, {:.6g}]]", r.data.start + s.from - 2 / r.data.rate,
                         r.data.start + length);
  else if (channel.empty())
    f.mend = fmt::format("time_offset = {:.6g}", r.time_offset - s.late);
  else
    f.mend = fmt::format("channels.\"{}\" = {{ late = {:.6g} }}", channel, s.late);
  return f;
}

bool AnyGross(const std::vector<const GateColumn*>& columns) {
  return std::ranges::any_of(columns, [](const GateColumn* c) {
    return c->match.error > kGrossError && c->match.error > 0.1 * c->match.predicted_move;
  });
}

bool RepeatsItself(const std::vector<const GateColumn*>& columns) {
  constexpr double kAway = 0.5, kBack = 0.8;  // correlation with itself
  const std::size_t rows = columns[0]->column.size();
  const std::size_t step = std::max<std::size_t>(1, rows / kGateRows);
  std::vector<MatchedColumn> itself;
  for (const GateColumn* c : columns) {
    itself.push_back(ThinnedColumn(*c, step));
    itself.back().measured = itself.back().predicted;
  }
  const auto most = static_cast<long>(kMostShift * static_cast<double>(itself[0].size()));
  bool away = false;
  for (long late = 1; late <= most; ++late) {
    double correlation = 0;
    for (const MatchedColumn& c : itself)
      correlation += MatchLater(c, late, 0).correlation / static_cast<double>(itself.size());
    away = away || correlation < kAway;
    if (away && correlation > kBack) return true;
  }
  return !away;
}

bool AreOnTime(const std::vector<const GateColumn*>& columns, double late, double rate) {
  constexpr double kBetter = 0.9;
  const auto rows = static_cast<long>(std::lround(late * rate));
  double as_it_is = 0, later = 0;
  for (const GateColumn* c : columns) {
    const double size = c->match.predicted_move;
    as_it_is += std::pow(c->match.error / size, 2);
    later += std::pow(MatchLater(c->column, rows, 0).error / size, 2);
  }
  return std::sqrt(as_it_is) < kBetter * std::sqrt(later);
}

}  // namespace ambrig
