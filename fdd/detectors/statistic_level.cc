#include "fdd/detectors/statistic_level.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ambrig {

namespace {

constexpr double kLowestLevel = 1e-3;

const std::array<double, kStatisticLevels>& Edges() {
  static const std::array<double, kStatisticLevels> edges = [] {
    std::array<double, kStatisticLevels> e{};
    for (int k = 1; k < kStatisticLevels; ++k)
      e[static_cast<std::size_t>(k)] =
          kLowestLevel * std::pow(10.0, static_cast<double>(k - 1) / kLevelsPerDecade);
    return e;
  }();
  return edges;
}

}  // namespace

int LevelOf(double statistic) {
  if (std::isnan(statistic)) return kStatisticLevels - 1;
  const auto& e = Edges();
  return std::max(
      0, static_cast<int>(std::upper_bound(e.begin(), e.end(), statistic) - e.begin()) - 1);
}

int LevelAtLeast(double threshold) {
  const int level = LevelOf(threshold);
  return ValueOf(level) < threshold ? std::min(level + 1, kStatisticLevels - 1) : level;
}

double ValueOf(int level) {
  return Edges()[static_cast<std::size_t>(std::clamp(level, 0, kStatisticLevels - 1))];
}

}  // namespace ambrig
