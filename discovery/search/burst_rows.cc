#include "discovery/search/burst_rows.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

constexpr double kLargeError = 6;          // floors
constexpr double kAroundBurst = 1e-3;      // [s] on either side
constexpr double kMostOfBurst = 0.1;       // of a channel
constexpr double kLeastOfChannel = 0.5;    // of its squared error above the noise
constexpr double kLeastOfAll = 1.0 / 3.0;  // of that of all these rows

struct ChannelBursts {
  std::vector<SampleSpan> spans;
  double inside = 0;  // squared error above the noise within the spans
  double all = 0;     // and of the whole channel
};

ChannelBursts BurstsOf(const CaseModel& model, const std::vector<double>& residual,
                       const Target& t) {
  ChannelBursts out;
  const auto around =
      static_cast<std::size_t>(std::ceil(kAroundBurst * model.data().records[t.record].data.rate));
  for (std::size_t k = t.first; k < t.first + t.count; ++k) {
    if (!model.ok()[k] || std::abs(residual[k]) <= kLargeError) continue;
    const std::size_t at = model.sample(k), from = at - std::min(at, around);
    if (!out.spans.empty() && from <= out.spans.back().last + 1)
      out.spans.back().last = at + around;
    else
      out.spans.push_back({t.record, from, at + around});
  }
  std::size_t span = 0;
  double counted = 0, within = 0;
  for (std::size_t k = t.first; k < t.first + t.count; ++k) {
    if (!model.ok()[k]) continue;
    while (span < out.spans.size() && out.spans[span].last < model.sample(k)) ++span;
    const double above = residual[k] * residual[k] - 1;
    const bool in = span < out.spans.size() && out.spans[span].first <= model.sample(k);
    counted += 1;
    within += in ? 1 : 0;
    out.all += above;
    out.inside += in ? above : 0;
  }
  if (within > kMostOfBurst * counted || out.inside < kLeastOfChannel * out.all) out.spans.clear();
  return out;
}

}  // namespace

std::vector<SampleSpan> BurstRows(const CaseModel& model, const std::vector<double>& residual,
                                  Which which) {
  std::vector<SampleSpan> spans;
  double inside = 0, all = 0;
  for (const Target& t : model.targets()) {
    if (!Counts(model, t, which)) continue;
    ChannelBursts b;
    if (OverTime(model.data().records[t.record])) b = BurstsOf(model, residual, t);
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      if (model.ok()[k]) all += residual[k] * residual[k] - 1;
    if (b.spans.empty()) continue;
    inside += b.inside;
    spans.insert(spans.end(), b.spans.begin(), b.spans.end());
  }
  if (spans.empty() || inside < kLeastOfAll * all) return {};
  return MergedSpans(std::move(spans));
}

}  // namespace ambrig
