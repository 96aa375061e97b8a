#include "discovery/calibration/reliability.h"

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"

namespace ambrig {

namespace {

constexpr std::uint32_t kDraws = 400;

double ErrorOfBins(const std::vector<ReliabilityBin>& bins) {
  double sum = 0, n = 0;
  for (const ReliabilityBin& b : bins) {
    sum += static_cast<double>(b.count) * std::abs(b.found - b.stated);
    n += static_cast<double>(b.count);
  }
  return n > 0 ? sum / n : 0;
}

}  // namespace

std::vector<ReliabilityBin> ReliabilityDiagram(const std::vector<JudgedStatement>& all, int bins) {
  std::vector<ReliabilityBin> out(static_cast<std::size_t>(bins));
  for (int k = 0; k < bins; ++k) {
    out[static_cast<std::size_t>(k)].lo = static_cast<double>(k) / bins;
    out[static_cast<std::size_t>(k)].hi = static_cast<double>(k + 1) / bins;
  }
  for (const JudgedStatement& s : all) {
    const int place = static_cast<int>(std::ceil(s.probability * bins)) - 1;
    ReliabilityBin& b = out[static_cast<std::size_t>(std::clamp(place, 0, bins - 1))];
    ++b.count;
    b.stated += s.probability;
    b.found += s.right ? 1 : 0;
  }
  for (ReliabilityBin& b : out) {
    if (b.count == 0) continue;
    b.stated /= static_cast<double>(b.count);
    b.found /= static_cast<double>(b.count);
  }
  return out;
}

CalibrationError ExpectedCalibrationError(const std::vector<JudgedStatement>& all, int bins,
                                          std::uint64_t seed) {
  CalibrationError e;
  if (all.empty()) return e;
  e.value = ErrorOfBins(ReliabilityDiagram(all, bins));
  double sum = 0, squares = 0, chance = 0;
  const double n = static_cast<double>(all.size());
  for (std::uint32_t draw = 0; draw < kDraws; ++draw) {
    std::vector<JudgedStatement> again, true_ones = all;
    for (std::uint32_t k = 0; k < all.size(); ++k) {
      again.push_back(
          all[std::min(all.size() - 1, static_cast<std::size_t>(n * Uniform(seed, 2 * draw, k)))]);
      true_ones[k].right = Uniform(seed, 2 * draw + 1, k) < all[k].probability;
    }
    const double value = ErrorOfBins(ReliabilityDiagram(again, bins));
    sum += value;
    squares += value * value;
    chance += ErrorOfBins(ReliabilityDiagram(true_ones, bins));
  }
  e.sd = std::sqrt(std::max(0.0, squares / kDraws - std::pow(sum / kDraws, 2)));
  e.by_chance = chance / kDraws;
  return e;
}

Share ShareOf(std::size_t right, std::size_t of) {
  Share s = {right, of};
  if (of == 0) return s;
  constexpr double z = 1.959964;
  const double n = static_cast<double>(of), p = static_cast<double>(right) / n;
  const double middle = (p + z * z / (2 * n)) / (1 + z * z / n),
               half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  s.value = p;
  s.lo = std::max(0.0, middle - half);
  s.hi = std::min(1.0, middle + half);
  return s;
}

}  // namespace ambrig
