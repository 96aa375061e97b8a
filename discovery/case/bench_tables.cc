#include "discovery/case/bench_tables.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/parameters.h"

namespace ambrig {

double CoherenceSd(double magnitude, double g2, double averages) {
  if (!(g2 > 0)) return kInfinity;
  const double counted = std::max(averages - 2, 0.5 * averages);
  return g2 < 1 ? magnitude * std::sqrt((1 - g2) / (2 * counted * g2)) : 0;
}

double MeterFrequency(const std::string& output) {
  const std::size_t at = output.find('@');
  if (at == std::string::npos) return 0;
  double f = 0;
  const char* const end = output.data() + output.size();
  const auto read = std::from_chars(output.data() + at + 1, end, f);
  return read.ptr == end && std::isfinite(f) && f > 0 ? f : std::nan("");
}

}  // namespace ambrig
