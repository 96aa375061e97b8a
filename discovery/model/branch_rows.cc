#include "discovery/model/branch_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"
#include "discovery/model/case_model.h"

namespace ambrig {

namespace {

constexpr double kJump = 6;             // floors
constexpr double kBelongsToJump = 1;    // floors, of the rows beside it
constexpr double kMostOfChannel = 0.3;  // of a channel
constexpr double kMostError = 2;        // floors rms that a branch counts with
// Lines through the drawing: points from -1.75 to 1.75 times a draw of the tolerances, half a draw
// apart.
constexpr int kToleranceLines = 6, kPoints = 8;
constexpr double kFirst = -1.75, kApart = 0.5;

/// The records in which branches are sought.
RecordSubset ClampedRecords(const CaseModel& model) {
  RecordSubset look{{}, std::vector<double>(model.size(), 0.0)};
  for (const CaseRecord& r : model.data().records)
    look.records.push_back(OverTime(r) && r.scenario.start == StartState::kClamped ? 1 : 0);
  return look;
}

std::vector<Hypothesis> PointsOnLine(const Hypothesis& nominal, int number) {
  constexpr std::uint64_t kSeed = 1;
  constexpr std::uint32_t kStream = 302;
  const std::size_t p = nominal.free.size();
  std::vector<Hypothesis> out(kPoints, nominal);
  for (std::size_t k = 0; k < p; ++k) {
    const double draw = Normal(kSeed, kStream, static_cast<std::uint64_t>(number) * p + k);
    for (int i = 0; i < kPoints; ++i) {
      const double value = nominal.ValueAt(k, nominal.Coordinate(k) + (kFirst + kApart * i) * draw);
      out[static_cast<std::size_t>(i)].Set(
          k, std::clamp(value, nominal.free[k].lo, nominal.free[k].hi));
    }
  }
  return out;
}

/// Marks the rows of a target at which the third difference of four predictions on a line jumps:
/// what is straight or bends evenly along the line has none.
void MarkJumps(const Target& t, const std::vector<const std::vector<double>*>& four,
               std::vector<char>& marks) {
  const auto jump = [&](std::size_t k) {
    return std::abs((*four[3])[k] - 3 * (*four[2])[k] + 3 * (*four[1])[k] - (*four[0])[k]) /
           t.floor;
  };
  const std::size_t end = t.first + t.count;
  for (std::size_t k = t.first; k < end; ++k) {
    if (jump(k) <= kJump) continue;
    std::size_t first = k;
    while (first > t.first && jump(first - 1) > kBelongsToJump) --first;
    while (k + 1 < end && jump(k + 1) > kBelongsToJump) ++k;
    std::fill(marks.begin() + static_cast<std::ptrdiff_t>(first),
              marks.begin() + static_cast<std::ptrdiff_t>(k + 1), 1);
  }
}

/// The marked rows of a target as spans of samples; none where they are too many.
void AddSpans(const CaseModel& model, const Target& t, const std::vector<char>& marks,
              std::vector<BranchSpan>& out) {
  const auto begin = marks.begin() + static_cast<std::ptrdiff_t>(t.first);
  const auto marked = std::count(begin, begin + static_cast<std::ptrdiff_t>(t.count), 1);
  if (static_cast<double>(marked) > kMostOfChannel * static_cast<double>(t.count)) return;
  for (std::size_t k = t.first; k < t.first + t.count; ++k) {
    if (!marks[k]) continue;
    const std::size_t first = k;
    while (k + 1 < t.first + t.count && marks[k + 1]) ++k;
    out.push_back({t.record, t.channel, model.sample(first), model.sample(k)});
  }
}

double RmsOver(const CaseModel& model, const RowRange& rows, const double* values) {
  double square = 0, n = 0;
  for (std::size_t k = rows.first; k < rows.first + rows.count; ++k)
    if (model.ok()[k]) square += values[k] * values[k], n += 1;
  return n > 0 ? std::sqrt(square / n) : 0;
}

}  // namespace

std::vector<BranchSpan> FindBranches(const CaseModel& model, const Hypothesis& nominal) {
  const RecordSubset look = ClampedRecords(model);
  std::vector<BranchSpan> out;
  if (nominal.free.empty() || std::ranges::count(look.records, 1) == 0) return out;
  std::vector<char> marks(model.size(), 0);
  for (int line = 0; line < kToleranceLines; ++line) {
    const auto runs =
        model.PredictAll(PointsOnLine(nominal, line), ModelFidelity::kAsSampled, &look);
    for (std::size_t i = 0; i + 3 < runs.size(); ++i) {
      std::vector<const std::vector<double>*> four;
      for (std::size_t k = i; k < i + 4; ++k)
        if (runs[k]) four.push_back(&*runs[k]);
      for (const Target& t : model.targets())
        if (four.size() == 4 && look.records[t.record]) MarkJumps(t, four, marks);
    }
  }
  for (const Target& t : model.targets()) AddSpans(model, t, marks, out);
  return out;
}

std::vector<RowRange> RowsIn(const CaseModel& model, const std::vector<BranchSpan>& spans) {
  std::vector<RowRange> out;
  for (const BranchSpan& s : spans)
    for (const Target& t : model.targets()) {
      if (t.record != s.record || t.channel != s.channel) continue;
      RowRange rows;
      for (std::size_t k = t.first; k < t.first + t.count; ++k) {
        if (model.sample(k) < s.first || model.sample(k) > s.last) continue;
        if (rows.count++ == 0) rows.first = k;
      }
      if (rows.count > 0) out.push_back(rows);
    }
  return out;
}

void LimitInBranches(const CaseModel& model, double* residual) {
  for (const RowRange& rows : model.branches) {
    const double rms = RmsOver(model, rows, residual);
    for (std::size_t k = rows.first; rms > kMostError && k < rows.first + rows.count; ++k)
      residual[k] *= kMostError / rms;
  }
}

void DropJumps(const CaseModel& model, double* change) {
  for (const RowRange& rows : model.branches)
    if (RmsOver(model, rows, change) > kJump) std::fill_n(change + rows.first, rows.count, 0.0);
}

std::vector<std::string> BranchRemarks(const CaseModel& model,
                                       const std::vector<BranchSpan>& spans) {
  std::vector<std::string> out;
  for (std::size_t r = 0; r < model.data().records.size(); ++r) {
    const CaseRecord& record = model.data().records[r];
    std::vector<std::string> channels;
    double longest = 0;
    for (const BranchSpan& s : spans) {
      if (s.record != r) continue;
      longest = std::max(longest, static_cast<double>(s.last + 1 - s.first) / record.data.rate);
      const std::string& name = record.data.channels[s.channel].name;
      if (std::ranges::find(channels, name) == channels.end()) channels.push_back(name);
    }
    if (!channels.empty())
      out.push_back(
          fmt::format("{}: in up to {:.2g} ms of {} the tolerances of the rig decide what a "
                      "limiter does: errors there count as "
                      "at most {:g} times the noise",
                      record.data_file, 1e3 * longest, fmt::join(channels, ", "), kMostError));
  }
  return out;
}

}  // namespace ambrig
