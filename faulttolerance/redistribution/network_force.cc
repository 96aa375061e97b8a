#include "faulttolerance/redistribution/network_force.h"

#include <algorithm>

#include "core/math/constants.h"

namespace ambrig {

namespace {
constexpr double kLeastGap = 0.1;  // of the nominal one
}  // namespace

NetworkForce::NetworkForce(const RedistributionProblem& b)
    : area_(b.pole_area),
      gap_(b.gap),
      cosine_(b.angle.array().cos()),
      sine_(b.angle.array().sin()),
      turns_(b.turns * b.turns_left.cwiseProduct(b.sign)) {
  MoveTo(0, 0);
}

void NetworkForce::MoveTo(double x, double y) {
  x_ = x;
  y_ = y;
  const CoilVector gap = (gap_ - x * cosine_.array() - y * sine_.array()).max(kLeastGap * gap_);
  permeance_ = kMu0 * area_ * gap.cwiseInverse();
  inverse_total_ = 1 / permeance_.sum();
}

CoilVector NetworkForce::Flux(const CoilVector& i) const {
  const CoilVector m = turns_.cwiseProduct(i);
  return permeance_.cwiseProduct((m.array() - permeance_.dot(m) * inverse_total_).matrix());
}

Eigen::Vector2d NetworkForce::Force(const CoilVector& i) const {
  const CoilVector pull = Flux(i).cwiseAbs2() / (2 * kMu0 * area_);
  return {pull.dot(cosine_), pull.dot(sine_)};
}

Eigen::Vector2d NetworkForce::Force(const CoilVector& i, ForceGradient* gradient) const {
  const CoilVector phi = Flux(i) / (kMu0 * area_);
  const auto row = [&](const CoilVector& direction) {
    const CoilVector w = phi.cwiseProduct(direction);
    const double mean = permeance_.dot(w) * inverse_total_;
    gradient->row(&direction == &sine_) =
        turns_.cwiseProduct(permeance_).cwiseProduct((w.array() - mean).matrix()).transpose();
  };
  row(cosine_);
  row(sine_);
  const CoilVector pull = phi.cwiseAbs2() * (0.5 * kMu0 * area_);
  return {pull.dot(cosine_), pull.dot(sine_)};
}

CoilVector NetworkForce::Contract(const ForceGradient& y) const {
  CoilVector sum = CoilVector::Zero();
  for (int a = 0; a < 2; ++a) {
    const CoilVector w =
        Flux(y.row(a).transpose()).cwiseProduct(a == 0 ? cosine_ : sine_) / (2 * kMu0 * area_);
    sum += turns_.cwiseProduct(permeance_)
               .cwiseProduct((w.array() - permeance_.dot(w) * inverse_total_).matrix());
  }
  return sum;
}

Eigen::Matrix2d NetworkForce::Stiffness(const CoilVector& current) const {
  NetworkForce at = *this;
  const double h = 1e-3 * gap_;
  Eigen::Matrix2d k;
  for (int a = 0; a < 2; ++a) {
    const double dx = a == 0 ? h : 0, dy = a == 1 ? h : 0;
    at.MoveTo(x_ + dx, y_ + dy);
    const Eigen::Vector2d plus = at.Force(current);
    at.MoveTo(x_ - dx, y_ - dy);
    k.col(a) = (plus - at.Force(current)) / (2 * h);
  }
  return k;
}

}  // namespace ambrig
