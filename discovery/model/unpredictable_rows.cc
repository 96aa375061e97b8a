#include "discovery/model/unpredictable_rows.h"

#include <algorithm>
#include <cmath>

#include "discovery/model/case_model.h"

namespace ambrig {

namespace {

constexpr double kFarOff = 5;         // robust sd
constexpr double kMostOfRows = 0.02;  // of a channel
constexpr double kAround = 5e-4;      // [s] that belong to an instant on either side

/// 1.4826 times the median of |d| over the rows of a target that count; 0 without rows.
double RobustSd(const CaseModel& model, const std::vector<double>& d, const Target& t) {
  std::vector<double> sizes;
  for (std::size_t k = t.first; k < t.first + t.count; ++k)
    if (model.ok()[k]) sizes.push_back(std::abs(d[k]));
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * *middle;
}

}  // namespace

std::vector<SampleSpan> MergedSpans(std::vector<SampleSpan> spans) {
  std::sort(spans.begin(), spans.end(), [](const SampleSpan& a, const SampleSpan& b) {
    return std::pair(a.record, a.first) < std::pair(b.record, b.first);
  });
  std::vector<SampleSpan> out;
  for (const SampleSpan& s : spans)
    if (!out.empty() && out.back().record == s.record && s.first <= out.back().last + 1)
      out.back().last = std::max(out.back().last, s.last);
    else
      out.push_back(s);
  return out;
}

std::vector<SampleSpan> UnpredictableRows(const CaseModel& model, const std::vector<double>& d1,
                                          const std::vector<double>& d2) {
  std::vector<SampleSpan> spans;
  for (const Target& t : model.targets()) {
    const CaseRecord& record = model.data().records[t.record];
    if (!OverTime(record)) continue;
    const double far = kFarOff * std::max(RobustSd(model, d1, t), RobustSd(model, d2, t));
    const auto around = static_cast<std::size_t>(std::ceil(kAround * record.data.rate));
    std::vector<SampleSpan> of_channel;
    for (std::size_t k = t.first; k < t.first + t.count && far > 0; ++k) {
      if (!model.ok()[k] || std::max(std::abs(d1[k]), std::abs(d2[k])) <= far) continue;
      const std::size_t at = model.sample(k);
      of_channel.push_back({t.record, at - std::min(at, around), at + around});
    }
    if (static_cast<double>(of_channel.size()) > kMostOfRows * static_cast<double>(t.count))
      continue;
    spans.insert(spans.end(), of_channel.begin(), of_channel.end());
  }
  return MergedSpans(std::move(spans));
}

}  // namespace ambrig
