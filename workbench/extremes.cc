#include "workbench/extremes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ambrig::workbench {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// fmin and fmax pass over nan.
void Widen(Extreme& e, float lo, float hi) {
  e.lo = std::fmin(e.lo, lo);
  e.hi = std::fmax(e.hi, hi);
}

void WidenBySamples(Extreme& e, std::span<const float> samples, std::size_t from, std::size_t to) {
  for (std::size_t k = from; k < to; ++k) Widen(e, samples[k], samples[k]);
}

}  // namespace

ExtremesLevel::ExtremesLevel(std::span<const float> samples) {
  blocks_.reserve(samples.size() / kBlock + 1);
  for (std::size_t from = 0; from < samples.size(); from += kBlock) {
    Extreme e{kNone, kNone};
    WidenBySamples(e, samples, from, std::min(from + kBlock, samples.size()));
    blocks_.push_back(e);
  }
}

std::vector<Extreme> ThinnedExtremes(std::span<const float> samples, const ExtremesLevel& level,
                                     std::size_t first, std::size_t last, std::size_t columns) {
  last = std::min(last, samples.size());
  first = std::min(first, last);
  std::vector<Extreme> out(columns, Extreme{kNone, kNone});
  constexpr std::size_t kBlock = ExtremesLevel::kBlock;
  for (std::size_t c = 0; c < columns; ++c) {
    const std::size_t from = first + (last - first) * c / columns;
    const std::size_t to = first + (last - first) * (c + 1) / columns;
    const std::size_t whole = (from + kBlock - 1) / kBlock, end = to / kBlock;
    if (whole >= end) {
      WidenBySamples(out[c], samples, from, to);
      continue;
    }
    WidenBySamples(out[c], samples, from, whole * kBlock);
    for (std::size_t b = whole; b < end; ++b)
      Widen(out[c], level.blocks()[b].lo, level.blocks()[b].hi);
    WidenBySamples(out[c], samples, end * kBlock, to);
  }
  return out;
}

}  // namespace ambrig::workbench
