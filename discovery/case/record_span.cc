#include "discovery/case/record_span.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ambrig {

namespace {

constexpr double kMuchLonger = 0.2;  // of the scenario's duration

/// Returns how long the rows that are cut off lasted [s].
double CutBefore(Record& data) {
  if (data.start >= 0) return 0;
  const auto rows = static_cast<std::ptrdiff_t>(std::ceil(-data.start * data.rate - 1e-9));
  if (rows <= 0 || static_cast<std::size_t>(rows) >= data.rows()) return 0;
  for (Channel& ch : data.channels) ch.samples.erase(ch.samples.begin(), ch.samples.begin() + rows);
  const double before = static_cast<double>(rows) / data.rate;
  data.start += before;
  return before;
}

/// Returns how long the rows that are cut off hold numbers [s].
double CutBehind(Record& data, double duration) {
  const auto most = static_cast<std::size_t>(
      std::max(0.0, std::floor((duration - data.start) * data.rate * (1 + 1e-9) + 1)));
  std::size_t behind = 0;
  for (Channel& ch : data.channels) {
    for (std::size_t k = most; k < ch.samples.size(); ++k)
      if (std::isfinite(ch.samples[k])) behind = std::max(behind, k + 1 - most);
    if (ch.samples.size() > most) ch.samples.resize(most);
  }
  return static_cast<double>(behind) / data.rate;
}

}  // namespace

void CutToScenario(CaseRecord& r, std::vector<std::string>& notes) {
  const double before = CutBefore(r.data), behind = CutBehind(r.data, r.scenario.duration);
  if (r.time_offset != 0) return;
  if (before > 0)
    notes.push_back(fmt::format("{}: the first {:.6g} s, before the scenario, are left out",
                                r.data_file, before));
  if (behind > kMuchLonger * r.scenario.duration)
    r.behind = behind;
  else if (behind >= 2 / r.data.rate)
    notes.push_back(fmt::format("{}: the last {:.6g} s, after the scenario, are left out",
                                r.data_file, behind));
}

std::size_t EmptyRows(const CaseRecord& r) {
  double rows = 0;
  for (const auto& [from, to] : r.gaps) rows += std::round((to - from) * r.data.rate) - 1;
  return static_cast<std::size_t>(rows);
}

void LeaveOutSpans(CaseRecord& r, const std::vector<std::vector<double>>& spans,
                   const TomlTable& t) {
  r.gaps = r.data.gaps;
  for (auto& [from, to] : r.gaps) from += r.time_offset, to += r.time_offset;
  for (const std::vector<double>& span : spans) {
    if (span.size() != 2 || !(span[0] <= span[1]))
      t.Fail("leave_out", "allowed: [[from, to], ...] in s of the scenario");
    const double row = 1 / r.data.rate;
    std::erase_if(r.gaps, [&](const auto& gap) {
      return span[0] <= gap.first + row && span[1] >= gap.second - row;
    });
    for (Channel& ch : r.data.channels)
      for (std::size_t k = 0; k < ch.samples.size(); ++k)
        if (const double at = r.data.TimeAt(k); at >= span[0] && at <= span[1])
          ch.samples[k] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace ambrig
