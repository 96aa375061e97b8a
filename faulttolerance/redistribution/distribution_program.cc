#include "faulttolerance/redistribution/distribution_program.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ambrig {
namespace {

constexpr double kSmooth = 1e-5;           // of |w|, healthy 1
constexpr double kSmoothStiffness = 1e-3;  // of the stiffness difference, healthy stiffness 1
constexpr std::pair<int, int> kPairs[6] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};

/// lambda_max of [k0 k1; k1 k2], smoothed, with gradient and Hessian in (k0, k1, k2).
struct SmoothEigenvalue {
  double value;
  Eigen::Vector3d gradient;
  Eigen::Matrix3d hessian;

  explicit SmoothEigenvalue(const Eigen::Vector3d& k) {
    const Eigen::Vector3d d(0.5, 0, -0.5), o(0, 1, 0), mean(0.5, 0, 0.5);
    const double half = d.dot(k), S = std::hypot(half, k[1], kSmoothStiffness);
    value = mean.dot(k) + S;
    const Eigen::Vector3d u = (half * d + k[1] * o) / S;
    gradient = mean + u;
    hessian = (d * d.transpose() + o * o.transpose() - u * u.transpose()) / S;
  }
};

SmallMatrix Restrict(const CoilForm& form, const std::vector<int>& live) {
  const int m = static_cast<int>(live.size());
  SmallMatrix small(m, m);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) small(i, j) = form(live[i], live[j]);
  return small;
}

}  // namespace

DistributionProgram::DistributionProgram(const RedistributionProblem& problem,
                                         const ForceForms& forms, int equations,
                                         const Weights& weights)
    : forms_(forms), quadrants_(problem.quadrants), equations_(equations), weights_(weights) {
  for (int j = 0; j < 8; ++j)
    if (problem.turns_left[j] > 0) live_.push_back(j);
  const int m = live_count();
  target_ = SmallVector::Zero(12);
  target_[2] = target_[5] = 1;
  for (const auto& [p, q] : kPairs)
    for (int axis = 0; axis < 2; ++axis) {
      const SmallMatrix Q = Restrict(forms.Q[axis], live_);
      SmallMatrix G = SmallMatrix::Zero(3 * m, 3 * m);
      G.block(p * m, q * m, m, m) += Q;
      G.block(q * m, p * m, m, m) += Q;
      G_.push_back(G);
    }
  for (int e = 0; e < 3; ++e) R_[e] = Restrict(forms.R[e], live_);
}

void DistributionProgram::AddBound(const SmallVector& row, double sigma, double r, double limit) {
  bounds_.push_back({row, sigma, r, weights_.T > 0 ? 1.0 : 0.0, limit});
}

void DistributionProgram::BoundCurrents(double rho, double limit) {
  const int m = live_count();
  for (int j = 0; j < m; ++j) {
    const SmallVector row = SmallVector::Unit(m, j);
    AddBound(row, -1, rho, limit);
    if (quadrants_ == 4)
      AddBound(row, 1, rho, limit);
    else
      bounds_.push_back({row, 1, rho, 0, 0});
  }
}

void DistributionProgram::BoundFluxes() {
  const int m = live_count();
  for (int pole = 0; pole < 8; ++pole) {
    SmallVector row(m);
    for (int j = 0; j < m; ++j) row[j] = forms_.flux(pole, live_[j]);
    AddBound(row, 1, 1, 0);
    AddBound(row, -1, 1, 0);
  }
}

Eigen::Vector3d DistributionProgram::Kappa(const SmallVector& x) const {
  const SmallVector b = x.head(live_count());
  return {b.dot(R_[0] * b), b.dot(R_[1] * b), b.dot(R_[2] * b)};
}

SmallVector DistributionProgram::Equations(const SmallVector& x) const {
  const auto W = x.head(3 * live_count());
  SmallVector c(equations_);
  for (int k = 0; k < equations_; ++k) c[k] = W.dot(G_[k] * W) / 2 - target_[k];
  return c;
}

SmallMatrix DistributionProgram::EquationJacobian(const SmallVector& x) const {
  const int w = 3 * live_count();
  SmallMatrix A = SmallMatrix::Zero(equations_, size());
  for (int k = 0; k < equations_; ++k) A.row(k).head(w) = (G_[k] * x.head(w)).transpose();
  return A;
}

double DistributionProgram::Objective(const SmallVector& x) const {
  const int m = live_count();
  double f = weights_.bias * x.head(m).squaredNorm() / 8 +
             weights_.control * x.segment(m, 2 * m).squaredNorm() / 8;
  if (weights_.T > 0) f += weights_.T * x[3 * m];
  if (weights_.stiffness > 0) f += weights_.stiffness * SmoothEigenvalue(Kappa(x)).value;
  if (weights_.error > 0)
    for (int k = equations_; k < 12; ++k) {
      const double e = x.head(3 * m).dot(G_[k] * x.head(3 * m)) / 2 - target_[k];
      f += weights_.error * e * e / 2;
    }
  return f;
}

SmallVector DistributionProgram::ObjectiveGradient(const SmallVector& x) const {
  const int m = live_count();
  SmallVector g = SmallVector::Zero(size());
  g.head(m) = weights_.bias / 4 * x.head(m);
  g.segment(m, 2 * m) = weights_.control / 4 * x.segment(m, 2 * m);
  if (weights_.T > 0) g[3 * m] = weights_.T;
  if (weights_.stiffness > 0) {
    const Eigen::Vector3d slope = SmoothEigenvalue(Kappa(x)).gradient;
    for (int e = 0; e < 3; ++e)
      g.head(m) += weights_.stiffness * 2 * slope[e] * (R_[e] * x.head(m));
  }
  if (weights_.error > 0)
    for (int k = equations_; k < 12; ++k) {
      const SmallVector Gx = G_[k] * x.head(3 * m);
      g.head(3 * m) += weights_.error * (x.head(3 * m).dot(Gx) / 2 - target_[k]) * Gx;
    }
  return g;
}

SmallVector DistributionProgram::Bounds(const SmallVector& x) const {
  const int m = live_count();
  SmallVector h(bounds());
  for (int i = 0; i < bounds(); ++i) {
    const Bound& d = bounds_[i];
    const double p = d.row.dot(x.segment(m, m)), q = d.row.dot(x.segment(2 * m, m));
    h[i] = d.constant + d.sigma * d.row.dot(x.head(m)) - d.r * std::hypot(p, q, kSmooth);
    if (d.tau > 0) h[i] += d.tau * x[3 * m];
  }
  return h;
}

SmallMatrix DistributionProgram::BoundJacobian(const SmallVector& x) const {
  const int m = live_count();
  SmallMatrix H = SmallMatrix::Zero(bounds(), size());
  for (int i = 0; i < bounds(); ++i) {
    const Bound& d = bounds_[i];
    const double p = d.row.dot(x.segment(m, m)), q = d.row.dot(x.segment(2 * m, m));
    const double norm = std::hypot(p, q, kSmooth);
    H.row(i).head(m) = d.sigma * d.row.transpose();
    H.row(i).segment(m, m) = -d.r * p / norm * d.row.transpose();
    H.row(i).segment(2 * m, m) = -d.r * q / norm * d.row.transpose();
    if (d.tau > 0) H(i, 3 * m) = d.tau;
  }
  return H;
}

SmallMatrix DistributionProgram::LagrangianHessian(const SmallVector& x, const SmallVector& y,
                                                   const SmallVector& z) const {
  const int m = live_count(), w = 3 * m;
  SmallMatrix L = SmallMatrix::Zero(size(), size());
  L.diagonal().head(m).array() += weights_.bias / 4;
  L.diagonal().segment(m, 2 * m).array() += weights_.control / 4;
  if (weights_.stiffness > 0) {
    const SmoothEigenvalue lambda(Kappa(x));
    SmallMatrix J(m, 3);
    for (int e = 0; e < 3; ++e) {
      J.col(e) = 2 * R_[e] * x.head(m);
      L.topLeftCorner(m, m) += weights_.stiffness * 2 * lambda.gradient[e] * R_[e];
    }
    L.topLeftCorner(m, m) += weights_.stiffness * J * lambda.hessian * J.transpose();
  }
  if (weights_.error > 0)
    for (int k = equations_; k < 12; ++k) {
      const SmallVector Gx = G_[k] * x.head(w);
      L.topLeftCorner(w, w) +=
          weights_.error * (Gx * Gx.transpose() + (x.head(w).dot(Gx) / 2 - target_[k]) * G_[k]);
    }
  for (int k = 0; k < equations_; ++k) L.topLeftCorner(w, w) -= y[k] * G_[k];
  for (int i = 0; i < bounds(); ++i) {
    const Bound& d = bounds_[i];
    const double p = d.row.dot(x.segment(m, m)), q = d.row.dot(x.segment(2 * m, m));
    const double norm = std::hypot(p, q, kSmooth), scale = z[i] * d.r / norm;
    const SmallMatrix outer = d.row * d.row.transpose();
    L.block(m, m, m, m) += scale * (1 - p * p / (norm * norm)) * outer;
    L.block(2 * m, 2 * m, m, m) += scale * (1 - q * q / (norm * norm)) * outer;
    L.block(m, 2 * m, m, m) -= scale * p * q / (norm * norm) * outer;
    L.block(2 * m, m, m, m) -= scale * p * q / (norm * norm) * outer;
  }
  return L;
}

DistributionMatrix DistributionProgram::ToMatrix(const SmallVector& x) const {
  DistributionMatrix W = DistributionMatrix::Zero();
  for (int j = 0; j < live_count(); ++j)
    for (int column = 0; column < 3; ++column) W(live_[j], column) = x[column * live_count() + j];
  return W;
}

SmallVector DistributionProgram::FromMatrix(const DistributionMatrix& W) const {
  SmallVector x = SmallVector::Zero(size());
  for (int j = 0; j < live_count(); ++j)
    for (int column = 0; column < 3; ++column) x[column * live_count() + j] = W(live_[j], column);
  if (weights_.T > 0) {
    const SmallVector h = Bounds(x);
    for (int i = 0; i < bounds(); ++i)
      if (bounds_[i].tau > 0) x[size() - 1] = std::max(x[size() - 1], 0.1 - h[i]);
  }
  return x;
}

}  // namespace ambrig
