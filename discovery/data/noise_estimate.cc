#include "discovery/data/noise_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ambrig {

namespace {

constexpr double kVarianceOfFourth = 70;  // 1 + 16 + 36 + 16 + 1
constexpr double kMadToSd = 1.4826;
constexpr std::size_t kLeastSamples = 32;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double QuantileOf(std::vector<double> values, double part) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return kNan;
  const double at = part * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(low), values.end());
  const double first = values[low];
  if (low + 1 >= values.size()) return first;
  const double second =
      *std::min_element(values.begin() + static_cast<std::ptrdiff_t>(low) + 1, values.end());
  return first + (at - static_cast<double>(low)) * (second - first);
}

double MedianOf(std::vector<double> values) { return QuantileOf(std::move(values), 0.5); }

double LowerQuartileOf(std::vector<double> values) { return QuantileOf(std::move(values), 0.25); }

double WhiteNoiseOf(const double* error, const char* ok, std::size_t count) {
  std::vector<double> size;
  double square = 0;
  for (std::size_t k = 0; k + 4 < count; ++k) {
    if (!(ok[k] && ok[k + 1] && ok[k + 2] && ok[k + 3] && ok[k + 4])) continue;
    const double d =
        error[k] - 4 * error[k + 1] + 6 * error[k + 2] - 4 * error[k + 3] + error[k + 4];
    size.push_back(std::abs(d));
    square += d * d;
  }
  if (size.size() < kLeastSamples) return kNan;
  const auto n = static_cast<double>(size.size());
  const double median = MedianOf(std::move(size));
  // A coarse converter repeats values: more than half of the differences may be zero.
  const double sd = median > 0 ? kMadToSd * median : std::sqrt(square / n);
  return sd / std::sqrt(kVarianceOfFourth);
}

}  // namespace ambrig
