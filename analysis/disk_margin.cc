#include "analysis/disk_margin.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/structured_singular_value.h"
#include "core/base/parameters.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;

constexpr double kUncoupled = 1e-6;  // of what an axis does to itself

/// Axes that reach one another, also by way of others.
std::vector<std::vector<std::size_t>> Groups(const std::vector<MatrixXcd>& S) {
  const auto n = static_cast<std::size_t>(S.front().rows());
  Eigen::MatrixXd largest = Eigen::MatrixXd::Zero(S.front().rows(), S.front().rows());
  for (const MatrixXcd& s : S) largest = largest.cwiseMax(s.cwiseAbs());
  std::vector<std::size_t> group(n);
  std::iota(group.begin(), group.end(), 0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
      if (largest(a, b) <= kUncoupled * std::min(largest(a, a), largest(b, b))) continue;
      const std::size_t to = std::min(group[i], group[j]), from = std::max(group[i], group[j]);
      std::replace(group.begin(), group.end(), from, to);
    }
  std::vector<std::vector<std::size_t>> out;
  for (std::size_t g = 0; g < n; ++g) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < n; ++i)
      if (group[i] == g) members.push_back(i);
    if (!members.empty()) out.push_back(std::move(members));
  }
  return out;
}

JointMargin MarginOf(const std::vector<std::size_t>& axes, const std::vector<double>& frequency,
                     const std::vector<MatrixXcd>& S) {
  JointMargin out;
  out.axes = axes;
  std::vector<Index> at(axes.begin(), axes.end());
  const auto changed = [&](std::size_t k) -> MatrixXcd {
    MatrixXcd M = S[k](at, at);
    M.diagonal().array() -= 0.5;
    return M;
  };
  std::vector<std::pair<double, std::size_t>> rough;
  for (std::size_t k = 0; k < S.size(); ++k)
    rough.push_back({BalancedUpperBound(changed(k)).value, k});
  std::sort(rough.begin(), rough.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  double peak = 0;
  std::size_t worst = 0;
  for (const auto& [bound, k] : rough) {
    if (bound <= peak) break;  // no later one can be the peak
    const double value = LeastUpperBound(changed(k)).value;
    if (value <= peak) continue;
    peak = value;
    worst = k;
  }
  out.alpha = peak > 0 ? 1 / peak : kInfinity;
  out.frequency = frequency[worst];
  const MuLower lower = LargestLowerBound(changed(worst));
  out.reached = lower.value > 0 ? 1 / lower.value : kInfinity;
  for (const Complex& d : lower.delta) out.factor.push_back((1.0 + 0.5 * d) / (1.0 - 0.5 * d));
  return out;
}

}  // namespace

double DiskGainDown(double alpha) { return alpha >= 2 ? 0 : (2 - alpha) / (2 + alpha); }
double DiskGainUp(double alpha) { return alpha >= 2 ? kInfinity : (2 + alpha) / (2 - alpha); }
double DiskPhase(double alpha) { return 2 * std::atan(alpha / 2); }

std::vector<JointMargin> FindJointMargins(const std::vector<double>& frequency,
                                          const std::vector<MatrixXcd>& S) {
  std::vector<JointMargin> out;
  if (S.empty()) return out;
  for (const auto& axes : Groups(S)) out.push_back(MarginOf(axes, frequency, S));
  return out;
}

}  // namespace ambrig
