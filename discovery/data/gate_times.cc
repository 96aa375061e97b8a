// Clocks and scenarios: records that come late, that lost a block, or that another command made.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "core/record/channels.h"
#include "discovery/data/data_gate.h"

namespace ambrig {

namespace {

constexpr double kMoves = 8;           // floors: a column that moves less tells no time
constexpr double kLeastShift = 5e-4;   // [s]: a smaller shift is a matter of the fit
constexpr double kLeastColumn = 1e-3;  // [s], of a single column: electronics delay too
constexpr double kMostShift = 0.2;     // of the record
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

/// The columns that move most and have no fault of their own.
std::vector<const GateColumn*> MovingColumns(const std::vector<GateColumn>& columns,
                                             std::size_t most) {
  std::vector<const GateColumn*> out;
  for (const GateColumn& c : columns)
    if (!c.explained && c.match.predicted_move > kMoves && c.match.measured_move > kMoves)
      out.push_back(&c);
  std::stable_sort(out.begin(), out.end(), [](const auto* a, const auto* b) {
    return a->match.predicted_move > b->match.predicted_move;
  });
  if (out.size() > most) out.resize(most);
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
  f.all_rows = f.from <= kEarly * static_cast<double>(rows) / rate;
  return f;
}

DataFault TimeFault(const CaseRecord& r, const std::string& channel, const FoundShift& s) {
  const double length = static_cast<double>(r.data.rows()) / r.data.rate;
  DataFault f;
  f.record = r.data_file;
  f.channel = channel;
  const bool lost = !s.all_rows && s.late < 0;
  f.fault = lost ? "lost" : "lag";
  f.seconds = lost ? -s.late : s.late;
  f.probability = std::clamp(1 - s.left * s.left, 0.5, 0.999);
  if (lost)
    f.mend = fmt::format("leave_out = [[{:.6g}, {:.6g}]]", r.data.start + s.from - 2 / r.data.rate,
                         r.data.start + length);
  else if (channel.empty())
    f.mend = fmt::format("time_offset = {:.6g}", r.time_offset - s.late);
  else
    f.mend = fmt::format("channels.\"{}\" = {{ late = {:.6g} }}", channel, s.late);
  return f;
}

}  // namespace

void CheckTimes(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  if (r.scenario.start == StartState::kResting) return;
  const std::vector<const GateColumn*> moving = MovingColumns(columns, kColumns);
  const bool gross = std::any_of(moving.begin(), moving.end(), [](const GateColumn* c) {
    return c->match.error > kGrossError && c->match.error > 0.1 * c->match.predicted_move;
  });
  if (gross) {
    const FoundShift s = ShiftOf(moving, r.data.rate);
    const double most = s.from > 0 ? 0.3 : 0.4;  // an instant more to choose
    if (std::abs(s.late) >= kLeastShift && s.left < most) {
      out.push_back(TimeFault(r, "", s));
      for (GateColumn& c : columns) c.explained = true;
      return;
    }
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
  // a rig that is late is so in all its columns; a logger's own delay is in one or two
  if (late.size() > 2) return;
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
  out.push_back(f);
}

namespace {

/// Error of the moving columns against predictions by name, over their movement.
double ErrorAgainstRecord(const std::vector<const GateColumn*>& moving, const Record& other,
                          std::size_t skip) {
  double sum = 0, n = 0;
  for (const GateColumn* c : moving) {
    const Channel* p = other.Find(c->name);
    if (!p) return kInfinity;
    std::vector<double> predicted(c->column.size());
    for (std::size_t k = 0; k < predicted.size(); ++k)
      predicted[k] = p->samples[std::min(skip + k, p->samples.size() - 1)] / c->floor;
    sum += std::pow(
        ErrorAgainst(c->column.measured, predicted, c->column.ok) / c->match.measured_move, 2);
    n += 1;
  }
  return n > 0 ? std::sqrt(sum / n) : kInfinity;
}

}  // namespace

void CheckScenario(const CaseModel& model, const Hypothesis& h, std::size_t record,
                   std::vector<GateColumn>& columns, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  if (r.scenario.start == StartState::kResting) return;
  std::vector<const GateColumn*> moving;
  double correlation = 0, error = 0;
  for (const GateColumn& c : columns)
    if (!c.explained && c.match.measured_move > kMoves && c.match.error > kGrossError)
      moving.push_back(&c);
  if (moving.size() < 2) return;
  for (const GateColumn* c : moving) {
    correlation += c->match.correlation / static_cast<double>(moving.size());
    error +=
        std::pow(c->match.error / c->match.measured_move, 2) / static_cast<double>(moving.size());
  }
  error = std::sqrt(error);
  if (correlation > 0.5 || error < 0.7) return;
  DataFault f;
  f.record = r.data_file;
  f.fault = "scenario";
  double least = 0.35 * error;
  for (std::size_t k = 0; k < model.data().records.size(); ++k) {
    const CaseRecord& o = model.data().records[k];
    if (k == record || !OverTime(o) || o.scenario.start != r.scenario.start ||
        o.scenario_file == r.scenario_file ||
        std::abs(o.data.rate - r.data.rate) > 1e-6 * r.data.rate)
      continue;
    try {
      const Record p = model.Simulated(h, k, false, 1);
      if (std::abs(p.rate - r.data.rate) > 1e-6 * p.rate) continue;
      const auto skip = static_cast<std::size_t>(std::lround(r.data.start * p.rate));
      const double left = ErrorAgainstRecord(moving, p, skip);
      if (left >= least) continue;
      least = left;
      f.with = o.scenario_file;
      f.probability = std::clamp(1 - std::pow(left / error, 2), 0.5, 0.999);
    } catch (const std::runtime_error&) {
      continue;  // that scenario cannot be run
    }
  }
  const bool strange = correlation < 0.15 && [&] {
    const auto n = std::count_if(moving.begin(), moving.end(), [](const GateColumn* c) {
      return c->match.predicted_move > 3 * kMoves;
    });
    return n >= 4 && 2 * n > static_cast<long>(columns.size());
  }();
  if (f.with.empty() && !strange) return;
  if (f.with.empty()) f.probability = 0.9;
  f.mend = f.with.empty() ? "" : fmt::format("scenario = \"{}\"", f.with);
  out.push_back(f);
  for (GateColumn& c : columns) c.explained = true;
}

}  // namespace ambrig
