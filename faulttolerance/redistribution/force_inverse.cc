#include "faulttolerance/redistribution/force_inverse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ambrig {

namespace {

// of the healthy bearing: below, the force is as good as stuck
constexpr double kLeastGain = 0.02;
constexpr double kDamping = 1e-6;  // of dF/di squared, where the free coils lose rank
constexpr int kStartIterations = 120;
constexpr double kMissed = 0.02, kMissedForce = 0.2;  // of the force, [N]
constexpr double kForceStep = 0.25;                   // [N]
constexpr double kCircleStep = 2;                     // [N] between circles
constexpr double kAllowedMiss = 0.1;                  // [N] that a step along the branch may add
constexpr double kTrust = 0.5;                        // [A] of a start's iteration

/// Low-discrepancy starts: additive recurrence with the roots of primes, 0 to 1.
double Share(int start, int coil) {
  constexpr std::array<double, 8> root = {1.41421356, 1.73205081, 2.23606798, 2.64575131,
                                          3.31662479, 3.60555128, 4.12310563, 4.35889894};
  const double u = (start + 1) * root[static_cast<std::size_t>(coil)];
  return u - std::floor(u);
}

}  // namespace

ForceInverse::ForceInverse(const RedistributionProblem& bearing, const ForceInverseOptions& options)
    : p_(bearing), o_(options), network_(bearing), unit_(ForceFactor(bearing) * bearing.c0) {
  for (int j = 0; j < 8; ++j) live_[j] = p_.turns_left[j] > 0 ? 1 : 0;
}

void ForceInverse::SetCurrents(const CoilVector& current) {
  i_ = current.cwiseProduct(live_).cwiseMin(p_.i_max).cwiseMax(p_.quadrants == 2 ? 0 : -p_.i_max);
}

double ForceInverse::least_gain() const {
  ForceGradient J;
  network_.Force(i_, &J);
  for (int j = 0; j < 8; ++j)
    if (p_.quadrants == 2 ? i_[j] < 0.02 * p_.c0 || i_[j] > p_.i_max * 0.999
                          : std::abs(i_[j]) > p_.i_max * 0.999)
      J.col(j).setZero();
  // Healthy: dF/di has two singular values k c0 / 2.
  const Eigen::Matrix2d D = J * J.transpose() / (0.25 * unit_ * unit_);
  const double mean = 0.5 * D.trace(), spread = std::hypot(0.5 * (D(0, 0) - D(1, 1)), D(0, 1));
  return std::sqrt(std::max(mean - spread, 0.0));
}

double ForceInverse::Merit() const {
  ForceGradient J;
  network_.Force(i_, &J);
  const double det = (J * J.transpose()).determinant() / std::pow(0.5 * unit_, 4);
  return i_.cwiseAbs2().dot(p_.turns_left) / (8 * p_.c0 * p_.c0) -
         o_.mu * std::log(std::max(det, 1e-12));
}

void ForceInverse::Iterate(const Eigen::Vector2d& force, const CoilVector& low,
                           const CoilVector& high) {
  ForceGradient J;
  const Eigen::Vector2d missing = force - network_.Force(i_, &J);
  const double scale = 1 / (8 * p_.c0 * p_.c0);
  Eigen::Matrix2d D = J * J.transpose();
  D += (kDamping * unit_ * unit_) * Eigen::Matrix2d::Identity();
  // Gradient and a positive diagonal in place of the Hessian.
  const ForceGradient y = D.inverse() * J;
  const CoilVector gradient =
      2 * scale * p_.turns_left.cwiseProduct(i_) - 4 * o_.mu * network_.Contract(y);
  const CoilVector inverse = (2 * scale * p_.turns_left.array() + 4 * o_.mu * scale).inverse();
  CoilVector d = CoilVector::Zero(), lo = low - i_, hi = high - i_;
  std::array<bool, 8> fixed{};
  for (int j = 0; j < 8; ++j) fixed[static_cast<std::size_t>(j)] = live_[j] == 0 || hi[j] <= lo[j];
  for (int round = 0; round < 8; ++round) {
    Eigen::Matrix2d S = (1e-9 * unit_ * unit_ / scale) * Eigen::Matrix2d::Identity();
    Eigen::Vector2d right = missing;
    for (int j = 0; j < 8; ++j) {
      if (fixed[static_cast<std::size_t>(j)]) {
        right -= J.col(j) * d[j];
      } else {
        S += inverse[j] * J.col(j) * J.col(j).transpose();
        right += inverse[j] * gradient[j] * J.col(j);
      }
    }
    const Eigen::Vector2d lambda = S.inverse() * right;
    bool again = false;
    for (int j = 0; j < 8; ++j) {
      if (fixed[static_cast<std::size_t>(j)]) continue;
      const double free = inverse[j] * (J.col(j).dot(lambda) - gradient[j]);
      d[j] = std::clamp(free, lo[j], hi[j]);
      if (d[j] != free) fixed[static_cast<std::size_t>(j)] = again = true;
    }
    if (!again) break;
  }
  // Shorter where the force would be missed by more than before: past the end of a branch whole
  // steps swing.
  const CoilVector before = i_;
  CoilVector best = i_;
  double least = missing.norm();
  const double allowed = kAllowedMiss + 0.5 * least;
  for (double share = 1; share > 0.1; share /= 2) {
    i_ = before + share * d;
    const double miss = (force - network_.Force(i_)).norm();
    if (miss <= allowed) return;
    if (miss < least) {
      least = miss;
      best = i_;
    }
  }
  i_ = best;
}

const CoilVector& ForceInverse::Step(const Eigen::Vector2d& force, double x, double y) {
  network_.MoveTo(x, y);
  const double least = p_.quadrants == 2 ? 0 : -p_.i_max;
  const CoilVector low = (i_.array() - o_.slew).max(least),
                   high = (i_.array() + o_.slew).min(p_.i_max);
  for (int n = 0; n < o_.iterations; ++n) Iterate(force, low, high);
  return i_;
}

bool ForceInverse::Start(const Eigen::Vector2d& force, double x, double y) {
  network_.MoveTo(x, y);
  const double least = p_.quadrants == 2 ? 0 : -p_.i_max;
  CoilVector best = i_;
  double lowest = 1e30;
  for (int start = 0; start < o_.starts; ++start) {
    for (int j = 0; j < 8; ++j) {
      const double sign = p_.quadrants == 2 || Share(start, (j + 3) % 8) > 0.5 ? 1 : -1;
      i_[j] = start == 0 ? p_.c0 * live_[j] : sign * live_[j] * p_.i_max * Share(start, j);
    }
    for (int n = 0; n < kStartIterations; ++n)
      Iterate(force, (i_.array() - kTrust).max(least), (i_.array() + kTrust).min(p_.i_max));
    const double error = (force - network_.Force(i_)).norm();
    if (!(error < kMissedForce + kMissed * force.norm()) || least_gain() < kLeastGain) continue;
    if (const double merit = Merit(); merit < lowest) {
      lowest = merit;
      best = i_;
    }
  }
  i_ = best;
  return lowest < 1e30;
}

InverseReach ReachOf(const RedistributionProblem& bearing, const Eigen::Vector2d& centre,
                     double most, const ForceInverseOptions& options) {
  InverseReach out;
  ForceInverse inverse(bearing, options);
  out.holds = inverse.Start(centre);
  if (!out.holds) return out;
  out.loss = inverse.current().cwiseAbs2().dot(bearing.turns_left) / (8 * bearing.c0 * bearing.c0);
  const auto follows = [&](const Eigen::Vector2d& f) {
    inverse.Step(f);
    const double error = (inverse.force() - f).norm();
    return error < kMissedForce + kMissed * f.norm();
  };
  for (double radius = kCircleStep; radius <= most + 1e-9; radius += kCircleStep) {
    for (double r = radius - kCircleStep; r < radius; r += kForceStep)
      if (!follows(centre + Eigen::Vector2d(r, 0))) return out;
    const int steps = static_cast<int>(std::ceil(2 * std::numbers::pi * radius / kForceStep));
    for (int n = 0; n <= steps; ++n) {
      const double angle = 2 * std::numbers::pi * n / steps;
      if (!follows(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)))) return out;
    }
    out.radius = radius;
  }
  return out;
}

}  // namespace ambrig
