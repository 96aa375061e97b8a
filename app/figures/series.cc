#include "app/figures/series.h"

#include <algorithm>
#include <cmath>

#include "app/text/format.h"
#include "core/base/errors.h"

namespace ambrig {
namespace {

// Walks the buckets; `size` ranks points within one, NaN-ranked points are gaps.
template <class Size>
Points KeepExtremes(std::span<const double> x, std::span<const double> y, std::size_t max_points,
                    Size size) {
  Require(x.size() == y.size(), "x and y of one size");
  const std::size_t n = x.size();
  Points out;
  if (n <= std::max<std::size_t>(max_points, 8)) {
    out.x.assign(x.begin(), x.end());
    out.y.assign(y.begin(), y.end());
    return out;
  }
  const std::size_t buckets = std::max<std::size_t>(1, (max_points - 2) / 2);
  std::vector<std::size_t> keep = {0};
  for (std::size_t b = 0; b < buckets; ++b) {
    const std::size_t begin = 1 + b * (n - 2) / buckets, end = 1 + (b + 1) * (n - 2) / buckets;
    std::size_t least = end, greatest = end, gap = end;
    for (std::size_t i = begin; i < end; ++i) {
      const double s = size(i);
      if (std::isnan(s)) {
        gap = i;
        continue;
      }
      if (least == end || s < size(least)) least = i;
      if (greatest == end || s > size(greatest)) greatest = i;
    }
    std::vector<std::size_t> here;
    for (const std::size_t i : {least, greatest, gap})
      if (i != end) here.push_back(i);
    std::ranges::sort(here);
    here.erase(std::ranges::unique(here).begin(), here.end());
    keep.insert(keep.end(), here.begin(), here.end());
  }
  keep.push_back(n - 1);
  for (const std::size_t i : keep) {
    out.x.push_back(x[i]);
    out.y.push_back(y[i]);
  }
  return out;
}

}  // namespace

Points Decimate(std::span<const double> x, std::span<const double> y, std::size_t max_points) {
  return KeepExtremes(x, y, max_points, [y](std::size_t i) { return y[i]; });
}

Points DecimateOrbit(std::span<const double> x, std::span<const double> y, std::size_t max_points) {
  return KeepExtremes(x, y, max_points,
                      [x, y](std::size_t i) { return x[i] * x[i] + y[i] * y[i]; });
}

std::vector<double> UniformTime(double start, double rate, std::size_t count) {
  std::vector<double> t(count);
  for (std::size_t i = 0; i < count; ++i) t[i] = start + static_cast<double>(i) / rate;
  return t;
}

DisplayUnit ChooseUnit(double largest, std::string_view unit) {
  // FormatSi knows which units take prefixes; ask it with one significant digit.
  const std::string text = FormatSi(largest, unit, 1);
  const std::string gap = "\u00a0";
  const std::size_t at = text.find(gap);
  if (largest == 0 || !std::isfinite(largest) || at == std::string::npos)
    return {1.0, std::string(unit)};
  const std::string name = text.substr(at + gap.size());
  if (name == unit) return {1.0, name};
  static constexpr std::pair<std::string_view, double> kFactors[] = {
      {"p", 1e12}, {"n", 1e9},  {"µ", 1e6},  {"m", 1e3},
      {"k", 1e-3}, {"M", 1e-6}, {"G", 1e-9}, {"T", 1e-12}};
  for (const auto& [prefix, factor] : kFactors)
    if (name == std::string(prefix) + std::string(unit)) return {factor, name};
  return {1.0, std::string(unit)};
}

double LargestSize(std::span<const double> values) {
  double largest = 0;
  for (const double v : values)
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  return largest;
}

double LargestRadius(std::span<const double> x, std::span<const double> y) {
  double squared = 0;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
    if (const double here = x[i] * x[i] + y[i] * y[i]; here > squared) squared = here;
  return std::sqrt(squared);
}

std::vector<double> Scaled(std::span<const double> values, double factor) {
  std::vector<double> out(values.begin(), values.end());
  for (double& v : out) v *= factor;
  return out;
}

}  // namespace ambrig
