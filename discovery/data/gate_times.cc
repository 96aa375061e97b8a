// Clocks: records and columns that come late, or that lost a block.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "core/record/channels.h"
#include "discovery/data/gate_columns.h"

namespace ambrig {

namespace {

constexpr double kLeastShift = 5e-4;   // [s]: a smaller shift is a matter of the fit
constexpr double kLeastRows = 10;      // of a block that is lost
constexpr double kLeastColumn = 1e-3;  // [s], of a single column: electronics delay too
constexpr double kMostShift = 0.2;     // of the record
constexpr double kNoWorse = 0.05;      // of what a shift gains: a shift of all rows gains as much
constexpr double kEarly = 0.03;        // of the record: a shift from there on is one of all rows
// A speed that is late by a clock has the profile's corners, one that lags behind by its drive has not: of a lag of at least
// the first share of the largest speed a drive leaves a tenth of the error after the best shift.
constexpr double kLateSpeed = 0.02, kSharpSpeed = 0.03;
constexpr std::size_t kColumns = 5;      // that move most are looked at
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

struct FoundShift {
  double late = 0, from = 0;  // [s], [s] after the first row
  double left = 1;            // share of the error that remains
  bool all_rows = true;       // from the record's beginning on, else rows were lost within it
};

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

/// Whether the error of any column is gross, also beside its movement.
bool AnyGross(const std::vector<const GateColumn*>& columns) {
  return std::ranges::any_of(columns, [](const GateColumn* c) {
    return c->match.error > kGrossError && c->match.error > 0.1 * c->match.predicted_move;
  });
}

/// Whether the prediction comes back to itself within the shifts that are tried: then a shift may be one of its periods,
/// or the phase of a whirl.
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

/// Beside an effect a shift leaves much. It is believed where it is longer than anything in a rig delays, where the movements
/// say clearly that it is right, and where the prediction does not repeat itself: the phase of a whirl is no clock.
bool IsClear(const std::vector<const GateColumn*>& moving, const FoundShift& s, double rate) {
  constexpr double kSurely = 4e-3;                                // [s]
  constexpr double kLeft = 0.7, kBefore = 0.5, kAfter = 0.75;     // of all rows [-]
  constexpr double kLeftFromThere = 0.5, kAfterFromThere = 0.85;  // an instant more to choose
  if (std::abs(s.late) < kSurely || s.left > (s.all_rows ? kLeft : kLeftFromThere)) return false;
  const auto rows = static_cast<long>(std::lround(s.late * rate));
  const long from = s.all_rows ? 0 : static_cast<long>(std::lround(s.from * rate));
  double before = 0, after = 0;
  for (const GateColumn* c : moving) {
    before += c->match.correlation / static_cast<double>(moving.size());
    after += MatchLater(c->column, rows, from).correlation / static_cast<double>(moving.size());
  }
  const bool clear = s.all_rows ? before < kBefore && after > kAfter : after > kAfterFromThere;
  return clear && !RepeatsItself(moving);
}

/// A clock that is wrong in all columns. Whether it is.
bool FindLateRecord(const CaseRecord& r, const std::vector<GateColumn>& columns,
                    std::vector<DataFault>& out) {
  const std::vector<const GateColumn*> moving = MovingColumns(columns, kColumns);
  if (!AnyGross(moving)) return false;
  const FoundShift s = ShiftOf(moving, r.data.rate);
  const double most = s.all_rows ? 0.4 : 0.3;  // an instant more to choose
  // what a fit may find is a shift of all rows
  const double least = s.all_rows ? kLeastShift : kLeastRows / r.data.rate;
  const bool believed =
      (std::abs(s.late) >= least && s.left < most) || IsClear(moving, s, r.data.rate);
  if (believed) out.push_back(TimeFault(r, "", s));
  return believed;
}

/// Whether columns agree with the prediction as it is rather than `late` seconds later.
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

/// The columns of one kind are late together and all others are on time: they have an instrument of their own.
void FindLateKind(const CaseRecord& r, ChannelKind kind, std::vector<GateColumn>& columns,
                  std::vector<DataFault>& out) {
  constexpr double kLeast = 2e-3, kLeft = 0.75;  // [s], of the error
  std::vector<const GateColumn*> own, others;
  for (const GateColumn* c : MovingColumns(columns, columns.size()))
    (IsOfKind(c->name, kind) ? own : others).push_back(c);
  if (own.size() < 2 || others.empty()) return;
  if (!AnyGross(own)) return;
  const FoundShift s = ShiftOf(own, r.data.rate);
  if (std::abs(s.late) < kLeast || s.left > kLeft || !s.all_rows ||
      !AreOnTime(others, s.late, r.data.rate) || RepeatsItself(own))
    return;
  for (GateColumn& c : columns) {
    if (c.explained || !IsOfKind(c.name, kind)) continue;
    out.push_back(TimeFault(r, c.name, s));
    c.explained = true;
  }
}

}  // namespace

void CheckTimes(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  if (r.scenario.start == StartState::kResting) return;
  for (const ChannelKind kind : {ChannelKind::kReading, ChannelKind::kCoilCurrent})
    FindLateKind(r, kind, columns, out);
  if (FindLateRecord(r, columns, out)) {
    for (GateColumn& c : columns) c.explained = true;
    return;
  }
  std::vector<std::pair<GateColumn*, FoundShift>> late;
  for (GateColumn& c : columns) {
    if (c.explained || c.match.predicted_move < kMoves || c.match.error < kGrossError ||
        c.match.error < 0.1 * c.match.predicted_move)
      continue;
    const FoundShift s = ShiftOf({&c}, r.data.rate);
    // rows are lost in all columns at once: what is late in one column is late from its first row on
    if (std::abs(s.late) >= kLeastColumn && s.left < 0.3 && s.all_rows) late.emplace_back(&c, s);
  }
  // a rig that is late is so in all its columns; a logger's own delay is in one or two, or in all of a kind
  if (late.size() > 2) late.clear();
  for (const auto& [c, s] : late) {
    out.push_back(TimeFault(r, c->name, s));
    c->explained = true;
  }
}

namespace {

/// The measured speed beside the scenario's profile; no rows where the speed is free or not recorded.
MatchedColumn SpeedColumn(const CaseRecord& r) {
  MatchedColumn c;
  const Channel* omega = Find(r.data, {ChannelKind::kSpeed});
  if (!omega || r.scenario.speed_free_from < r.scenario.duration) return c;
  for (std::size_t k = 0; k < omega->samples.size(); ++k) {
    const double y = omega->samples[k];
    c.ok.push_back(std::isfinite(y) ? 1 : 0);
    c.measured.push_back(std::isfinite(y) ? y : 0);
    c.predicted.push_back(r.scenario.speed.Speed(r.data.TimeAt(k)));
  }
  return c;
}

double LargestOf(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

}  // namespace

void CheckSpeedTime(const CaseModel& model, std::size_t record,
                    const std::vector<GateColumn>& columns, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  const bool told = std::any_of(out.begin(), out.end(), [&](const DataFault& f) {
    return f.record == r.data_file && (f.channel.empty() || f.channel == "omega");
  });
  if (told) return;
  GateColumn speed{"omega", SpeedColumn(r), {}, 1, false};
  if (speed.column.size() == 0) return;
  speed.match = MatchOf(speed.column);
  if (speed.match.predicted_move == 0 ||
      speed.match.error < kLateSpeed * LargestOf(speed.column.predicted))
    return;
  const FoundShift s = ShiftOf({&speed}, r.data.rate);
  if (std::abs(s.late) < kLeastColumn || s.left > kSharpSpeed) return;
  out.push_back(TimeFault(r, MovingColumns(columns, 1).empty() ? "" : "omega", s));
}

void CheckSpeed(const CaseModel& model, std::size_t record, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  const MatchedColumn c = SpeedColumn(r);
  if (c.size() == 0) return;
  const double most = LargestOf(c.predicted);
  const double before = ErrorAgainst(c.measured, c.predicted, c.ok);
  if (before < 5 + 0.05 * most) return;
  DataFault f;
  f.record = r.data_file;
  f.channel = "omega";
  f.probability = 0.98;
  for (const auto& [factor, line] : {std::pair{60 / (2 * kPi), "unit = \"rpm\""},
                                     {1 / (2 * kPi), "unit = \"Hz\""},
                                     {2 * kPi / 60, "gain = 9.5492966"},
                                     {2 * kPi, "gain = 0.15915494"},
                                     {-1.0, "gain = -1"}}) {
    if (ErrorAgainst(c.measured, c.predicted, c.ok, factor) / std::abs(factor) > 0.1 * before)
      continue;
    f.fault = factor < 0 ? "sign" : "unit";
    f.factor = factor;
    f.mend = fmt::format("channels.\"omega\" = {{ {} }}", line);
    out.push_back(f);
    return;
  }
  f.fault = "scenario";
  f.channel = "";
  TellScenario(f, out);
}

}  // namespace ambrig
