#include "discovery/model/residual.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/record/channels.h"

namespace ambrig {

namespace {

/// With the nuisances still in it.
std::vector<double> WholeResidual(const CaseModel& model, const std::vector<double>& predicted) {
  std::vector<double> r(model.size());
  ChangeOverFloor(model, predicted, model.measured(), r.data());
  LimitInBranches(model, r.data());
  return r;
}

/// Why the first channel that does not count is left out.
std::string FirstReason(const Case& c) {
  for (const CaseRecord& r : c.records)
    for (const ChannelQuality& q : r.quality)
      if (!q.use) return fmt::format("{}: {} is {}", r.data_file, q.channel, q.verdict);
  return "no row of any counts";
}

}  // namespace

std::vector<double> Residual(const CaseModel& model, const std::vector<double>& predicted,
                             const RecordSubset* look) {
  std::vector<double> r = WholeResidual(model, predicted);
  if (model.nuisances.any()) model.nuisances.Eliminate(r.data(), look ? &look->records : nullptr);
  return r;
}

std::vector<NuisanceFound> AmountsOfNuisances(const CaseModel& model,
                                              const std::vector<double>& predicted) {
  return model.nuisances.Amounts(model, WholeResidual(model, predicted));
}

void ChangeOverFloor(const CaseModel& model, const std::vector<double>& from,
                     const std::vector<double>& to, double* out) {
  for (const Target& t : model.targets())
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      out[k] = model.ok()[k] ? (to[k] - from[k]) / t.floor : 0;
}

bool Counts(const CaseModel& model, const Target& t, Which which) {
  if (which == Which::kAll) return true;
  return model.data().records[t.record].validate == (which == Which::kValidate);
}

double CountedRows(const CaseModel& model, const Target& t) {
  const auto first = model.ok().begin() + static_cast<std::ptrdiff_t>(t.first);
  return static_cast<double>(std::count(first, first + static_cast<std::ptrdiff_t>(t.count), 1));
}

void RequireCountedRows(const CaseModel& model) {
  if (std::ranges::any_of(model.targets(),
                          [&](const Target& t) { return CountedRows(model, t) > 0; }))
    return;
  throw InputError(
      fmt::format("{}: every channel of every record was left out ({}), allowed: one channel or "
                  "more that moves",
                  model.data().file, FirstReason(model.data())));
}

double TargetRatio(const CaseModel& model, const std::vector<double>& residual, const Target& t) {
  double sum = 0, n = 0;
  for (std::size_t k = t.first; k < t.first + t.count; ++k) {
    sum += residual[k] * residual[k];
    n += model.ok()[k];
  }
  return n > 0 ? std::sqrt(sum / n) : 0;
}

double WorthOfPoint(const CaseModel& model) {
  if (std::ranges::all_of(model.data().records, OverTime)) return 1;
  double rows = 0;
  for (const Target& t : model.targets())
    if (OverTime(model.data().records[t.record])) rows += CountedRows(model, t);
  return std::max(1.0, rows / kFloorNumbers);
}

double RatioOf(const ErrorSums& s, double worth_of_point) {
  if (s.rows == 0 || s.points == 0) {
    const double n = s.rows + s.points;
    return n > 0 ? std::sqrt((s.square + s.square_points) / n) : 0;
  }
  return std::sqrt(
      (std::max(s.square, s.rows) + worth_of_point * std::max(s.square_points, s.points)) /
      (s.rows + worth_of_point * s.points));
}

double Ratio(const CaseModel& model, const std::vector<double>& residual, Which which) {
  ErrorSums sums;
  for (const Target& t : model.targets()) {
    if (!Counts(model, t, which)) continue;
    const bool rows = OverTime(model.data().records[t.record]);
    double& square = rows ? sums.square : sums.square_points;
    double& n = rows ? sums.rows : sums.points;
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      square += residual[k] * residual[k];
      n += model.ok()[k];
    }
  }
  return RatioOf(sums, sums.points > 0 ? WorthOfPoint(model) : 1);
}

double KnownRatio(const CaseModel& model, const std::vector<double>& residual, Which which) {
  const bool any = std::ranges::any_of(model.targets(), [&](const Target& t) {
    return Counts(model, t, which) && CountedRows(model, t) > 0;
  });
  return any ? Ratio(model, residual, which) : std::nan("");
}

double UnseenRatio(const CaseModel& model, const std::vector<double>& residual) {
  const double unseen = Ratio(model, residual, Which::kValidate);
  return unseen > 0 ? unseen : Ratio(model, residual, Which::kFit);
}

std::vector<RecordError> RecordErrors(const CaseModel& model, const std::vector<double>& residual) {
  std::vector<RecordError> errors(model.data().records.size());
  for (std::size_t r = 0; r < errors.size(); ++r) errors[r].record = r;
  for (const Target& t : model.targets())
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      errors[t.record].square += residual[k] * residual[k];
      errors[t.record].rows += model.ok()[k];
    }
  return errors;
}

double WorstRecordRatio(const CaseModel& model, const std::vector<double>& residual) {
  double worst = 0;
  for (const RecordError& e : RecordErrors(model, residual))
    if (e.rows > 0) worst = std::max(worst, std::sqrt(e.square / e.rows));
  return worst;
}

bool ShowsMotion(const CaseModel& model, const Target& t) {
  const CaseRecord& record = model.data().records[t.record];
  const std::string& channel = record.data.channels[t.channel].name;
  if (record.kind == RecordKind::kFrf) return record.scenario.start != StartState::kClamped;
  return record.kind == RecordKind::kTime && record.scenario.start != StartState::kClamped &&
         (IsOfKind(channel, ChannelKind::kReading) || IsOfKind(channel, ChannelKind::kSetPoint));
}

double WorstMotionRatio(const CaseModel& model, const std::vector<double>& residual) {
  std::vector<RecordError> errors(model.data().records.size());
  for (const Target& t : model.targets()) {
    if (!ShowsMotion(model, t)) continue;
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      errors[t.record].square += residual[k] * residual[k];
      errors[t.record].rows += model.ok()[k];
    }
  }
  double worst = 0;
  for (const RecordError& e : errors)
    if (e.rows > 0) worst = std::max(worst, std::sqrt(e.square / e.rows));
  return worst;
}

double WorstRatio(const CaseModel& model, const std::vector<double>& residual, Which which) {
  double worst = 0;
  for (const Target& t : model.targets())
    if (Counts(model, t, which)) worst = std::max(worst, TargetRatio(model, residual, t));
  return worst;
}

}  // namespace ambrig
