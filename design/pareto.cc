#include "design/pareto.h"

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"

namespace ambrig {

bool Dominates(const std::vector<double>& a, const std::vector<double>& b) {
  bool better = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] > b[k]) return false;
    better = better || a[k] < b[k];
  }
  return better;
}

std::vector<std::size_t> ParetoFront(const std::vector<std::vector<double>>& points) {
  std::vector<std::size_t> front;
  for (std::size_t k = 0; k < points.size(); ++k) {
    bool stands =
        std::all_of(points[k].begin(), points[k].end(), [](double v) { return std::isfinite(v); });
    for (std::size_t j = 0; stands && j < points.size(); ++j)
      stands = !Dominates(points[j], points[k]) && !(j < k && points[j] == points[k]);
    if (stands) front.push_back(k);
  }
  return front;
}

std::size_t Compromise(const std::vector<std::vector<double>>& points,
                       const std::vector<std::size_t>& among, const std::vector<double>& scales) {
  Require(!among.empty(), "a point to choose");
  const auto worst = [&](std::size_t k) {
    double most = 0;
    for (std::size_t j = 0; j < scales.size(); ++j) most = std::max(most, points[k][j] / scales[j]);
    return most;
  };
  return *std::min_element(among.begin(), among.end(),
                           [&](std::size_t a, std::size_t b) { return worst(a) < worst(b); });
}

}  // namespace ambrig
