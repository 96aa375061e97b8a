#include "core/math/box_solver.h"

#include <algorithm>
#include <vector>

#include "core/math/linear_equations.h"

namespace ambrig {

using Eigen::Index;

namespace {

/// The unknowns that no limit holds.
std::vector<Index> FreeOnes(const std::vector<char>& held) {
  std::vector<Index> free;
  for (std::size_t k = 0; k < held.size(); ++k)
    if (!held[k]) free.push_back(static_cast<Index>(k));
  return free;
}

/// Least of the free unknowns, the others as they stand in x.
Eigen::VectorXd Least(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& x,
                      const std::vector<Index>& free) {
  Eigen::VectorXd fixed = x;
  for (const Index k : free) fixed(k) = 0;
  const Eigen::VectorXd right = b - A * fixed;
  return SolveSymmetric(A(free, free), right(free));
}

/// Goes towards `wanted` until the first limit, which then holds. Returns whether it got there.
bool Advance(const Eigen::VectorXd& wanted, const std::vector<Index>& free,
             const Eigen::VectorXd& lo, const Eigen::VectorXd& hi, Eigen::VectorXd& x,
             std::vector<char>& held) {
  double step = 1;
  Index stopped = -1;
  for (std::size_t k = 0; k < free.size(); ++k) {
    const Index i = free[k];
    const double to = wanted(static_cast<Index>(k)), limit = to < lo(i) ? lo(i) : hi(i);
    if (to >= lo(i) && to <= hi(i)) continue;
    const double part = to == x(i) ? 0 : (limit - x(i)) / (to - x(i));
    if (stopped < 0 || part < step) step = part, stopped = i;
  }
  for (std::size_t k = 0; k < free.size(); ++k)
    x(free[k]) += step * (wanted(static_cast<Index>(k)) - x(free[k]));
  if (stopped < 0) return true;
  x(stopped) = wanted(std::find(free.begin(), free.end(), stopped) - free.begin()) < lo(stopped)
                   ? lo(stopped)
                   : hi(stopped);
  held[static_cast<std::size_t>(stopped)] = 1;
  return false;
}

}  // namespace

Eigen::VectorXd SolveInBox(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                           const Eigen::VectorXd& lo, const Eigen::VectorXd& hi) {
  const Index n = b.size();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n).cwiseMax(lo).cwiseMin(hi);
  std::vector<char> held(static_cast<std::size_t>(n), 0);
  const double scale = std::max(1e-300, b.cwiseAbs().maxCoeff());
  for (Index round = 0; round < 20 * (n + 1); ++round) {
    const std::vector<Index> free = FreeOnes(held);
    if (!free.empty() && !Advance(Least(A, b, x, free), free, lo, hi, x, held)) continue;
    // the held one that most wants to come back inside
    const Eigen::VectorXd down = b - A * x;
    Index released = -1;
    double most = 1e-12 * scale;
    for (Index k = 0; k < n; ++k) {
      if (!held[static_cast<std::size_t>(k)] || lo(k) == hi(k)) continue;
      const double inward = x(k) <= lo(k) ? down(k) : -down(k);
      if (inward > most) most = inward, released = k;
    }
    if (released < 0) break;
    held[static_cast<std::size_t>(released)] = 0;
  }
  return x;
}

}  // namespace ambrig
