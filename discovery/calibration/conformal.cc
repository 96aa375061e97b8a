#include "discovery/calibration/conformal.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

double ConformalPValue(const std::vector<double>& scores, double score) {
  const auto larger =
      std::count_if(scores.begin(), scores.end(), [&](double s) { return s >= score; });
  return (1 + static_cast<double>(larger)) / (1 + static_cast<double>(scores.size()));
}

double LeastProbabilityOfSet(const std::vector<double>& scores, double level) {
  std::vector<double> sorted = scores;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  // No practice case scored above the name: its p-value is 1/(n + 1).
  if (1 / (1 + static_cast<double>(sorted.size())) > 1 - level) return 0;
  for (const double s : sorted)
    if (ConformalPValue(scores, s) > 1 - level) return std::max(0.0, 1 - s);
  return 0;
}

}  // namespace ambrig
