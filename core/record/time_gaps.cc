#include "core/record/time_gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ambrig {

namespace {

constexpr std::size_t kLeastRows = 20;
constexpr double kMostGaps = 0.02;  // of the rows; one in any case
constexpr double kLargest = 10;     // rows lost over rows there
constexpr double kWhole = 0.15;     // distance of a jump from a whole number of steps

/// Steps from each time to the next, 1 but for jumps; empty: not all of them are whole.
std::vector<std::size_t> WholeSteps(const std::vector<double>& t) {
  std::vector<double> step;
  for (std::size_t k = 1; k < t.size(); ++k) step.push_back(t[k] - t[k - 1]);
  std::vector<double> sorted = step;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  std::vector<std::size_t> out;
  for (const double s : step) {
    const double steps = s / *middle, whole = std::round(steps);
    if (!(*middle > 0) || !(std::abs(steps - whole) < kWhole) || whole < 1 || whole > 1e8)
      return {};
    out.push_back(static_cast<std::size_t>(whole));
  }
  return out;
}

}  // namespace

void FillGaps(Record& record, std::vector<double>& t) {
  const std::size_t rows = t.size();
  if (rows < kLeastRows) return;
  const std::vector<std::size_t> steps = WholeSteps(t);
  double gaps = 0, lost = 0;
  for (const std::size_t s : steps)
    if (s > 1) gaps += 1, lost += static_cast<double>(s - 1);
  if (gaps == 0 || gaps > std::max(1.0, kMostGaps * static_cast<double>(rows)) ||
      lost > kLargest * static_cast<double>(rows))
    return;
  const auto filled = [&](const std::vector<double>& old, const auto& between) {
    std::vector<double> out = {old[0]};
    for (std::size_t k = 0; k < steps.size(); ++k) {
      for (std::size_t n = 1; n < steps[k]; ++n) out.push_back(between(k, n));
      out.push_back(old[k + 1]);
    }
    return out;
  };
  for (Channel& c : record.channels)
    c.samples = filled(c.samples, [](std::size_t, std::size_t) {
      return std::numeric_limits<double>::quiet_NaN();
    });
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (steps[k] > 1) record.gaps.emplace_back(t[k], t[k + 1]);
  t = filled(t, [&](std::size_t k, std::size_t n) {
    return t[k] + (t[k + 1] - t[k]) * static_cast<double>(n) / static_cast<double>(steps[k]);
  });
}

}  // namespace ambrig
