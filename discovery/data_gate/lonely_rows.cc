#include "discovery/data_gate/lonely_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/counted.h"
#include "discovery/data/noise_estimate.h"

namespace ambrig {

namespace {

constexpr double kTimesNoise = 50;  // of the white noise
constexpr double kTimesFloor = 5;   // of the floor at least: a column without noise has roundings
constexpr std::size_t kFewLonely = 3;
constexpr double kFewOfRows = 5e-4;
constexpr double kExpected =
    0.1;  // of its size that the prediction may come and go by, near the row
constexpr std::size_t kNearRows = 3;  // rows

/// How far value k stands apart from the two on either side, with its sign; 0 within their range.
double Apart(const double* y, std::size_t k) {
  const auto [low, high] = std::minmax({y[k - 2], y[k - 1], y[k + 1], y[k + 2]});
  return y[k] > high ? y[k] - high : y[k] < low ? y[k] - low : 0;
}

/// Whether the prediction itself comes and goes by some of `size` near the row.
bool IsExpected(const double* predicted, std::size_t count, std::size_t k, double size) {
  for (std::size_t near = std::max<std::size_t>(k, kNearRows + 2) - kNearRows;
       near <= k + kNearRows && near + 2 < count; ++near)
    if (std::abs(Apart(predicted, near)) > kExpected * std::abs(size)) return true;
  return false;
}

std::vector<std::size_t> LonelyOf(const CaseModel& model, const std::vector<double>& predicted,
                                  const Target& t) {
  std::vector<double> error(t.count);
  const double* const measured = model.measured().data() + t.first;
  const double* const expected = predicted.data() + t.first;
  const char* const ok = model.ok().data() + t.first;
  for (std::size_t k = 0; k < t.count; ++k) error[k] = measured[k] - expected[k];
  const double noise = WhiteNoiseOf(error.data(), ok, t.count);
  std::vector<std::size_t> out;
  if (!std::isfinite(noise)) return out;
  const double least = std::max(kTimesNoise * noise, kTimesFloor * t.floor);
  for (std::size_t k = 2; k + 2 < t.count; ++k) {
    if (!std::all_of(ok + k - 2, ok + k + 3, [](char v) { return v != 0; })) continue;
    const double size = Apart(error.data(), k), seen = Apart(measured, k);
    if (std::abs(size) > least && std::abs(seen) > least && size * seen > 0 &&
        !IsExpected(expected, t.count, k, size))
      out.push_back(k);
  }
  const auto most =
      std::max(static_cast<double>(kFewLonely), kFewOfRows * static_cast<double>(t.count));
  return static_cast<double>(out.size()) <= most ? out : std::vector<std::size_t>{};
}

}  // namespace

std::vector<LonelyRow> LonelyRowsOf(const CaseModel& model, const std::vector<double>& predicted) {
  std::vector<LonelyRow> all;
  std::map<std::pair<std::size_t, std::size_t>, int>
      columns;  // of a record's sample and those beside it
  for (const Target& t : model.targets()) {
    if (!OverTime(model.data().records[t.record])) continue;
    for (const std::size_t k : LonelyOf(model, predicted, t)) {
      const std::size_t sample = model.sample(t.first + k);
      all.push_back({t.record, t.channel, sample});
      for (const std::size_t at : {sample - 1, sample, sample + 1}) ++columns[{t.record, at}];
    }
  }
  // what the machine does in one row shows in several columns
  std::erase_if(all, [&](const LonelyRow& r) { return columns[{r.record, r.sample}] > 1; });
  return all;
}

std::vector<SampleSpan> SpansOf(const std::vector<LonelyRow>& rows) {
  std::vector<SampleSpan> out;
  for (const LonelyRow& r : rows) out.push_back({r.record, r.sample, r.sample});
  return MergedSpans(std::move(out));
}

std::vector<std::string> LonelyRemarks(const Case& c, const std::vector<LonelyRow>& rows) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < rows.size();) {
    const LonelyRow& first = rows[k];
    std::size_t count = 0;
    for (; k < rows.size() && rows[k].record == first.record && rows[k].channel == first.channel;
         ++k)
      ++count;
    const CaseRecord& r = c.records[first.record];
    out.push_back(fmt::format("{}: {}: {} {} alone ({} {:.6g} s), left out", r.data_file,
                              r.data.channels[first.channel].name, Counted(count, "sample"),
                              count == 1 ? "stands" : "stand", count == 1 ? "at" : "first at",
                              r.data.TimeAt(first.sample)));
  }
  return out;
}

}  // namespace ambrig
