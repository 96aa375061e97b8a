#include "analysis/structured_singular_value.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <complex>

#include "core/math/constants.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double kReach = 8;  // of log d round the balanced scaling: ratios up to e^16

MatrixXcd Scaled(const MatrixXcd& M, const VectorXd& x) {
  return x.array().exp().matrix().asDiagonal() * M * (-x).array().exp().matrix().asDiagonal();
}

/// log σ_max of the scaled matrix and a subgradient by x = log d.
double LogNorm(const MatrixXcd& M, const VectorXd& x, VectorXd& gradient) {
  const Eigen::JacobiSVD<MatrixXcd> svd(Scaled(M, x), Eigen::ComputeFullU | Eigen::ComputeFullV);
  gradient = svd.matrixU().col(0).cwiseAbs2() - svd.matrixV().col(0).cwiseAbs2();
  return std::log(svd.singularValues()(0));
}

Complex Phase(Complex z) { return std::abs(z) > 0 ? z / std::abs(z) : Complex(1); }

}  // namespace

MuUpper BalancedUpperBound(const MatrixXcd& M) {
  const Index n = M.rows();
  VectorXd x = VectorXd::Zero(n);
  for (int sweep = 0; sweep < 20; ++sweep)
    for (Index i = 0; i < n; ++i) {
      double row = 0, column = 0;
      for (Index j = 0; j < n; ++j)
        if (j != i) {
          row += std::norm(M(i, j)) * std::exp(2 * (x(i) - x(j)));
          column += std::norm(M(j, i)) * std::exp(2 * (x(j) - x(i)));
        }
      if (row > 0 && column > 0)
        x(i) = std::clamp(x(i) + 0.25 * std::log(column / row), -kReach, kReach);
    }
  return {Eigen::JacobiSVD<MatrixXcd>(Scaled(M, x)).singularValues()(0), x};
}

MuUpper LeastUpperBound(const MatrixXcd& M, double accuracy) {
  MuUpper best = BalancedUpperBound(M);
  const auto n = static_cast<double>(M.rows());
  if (M.rows() < 2 || !(best.value > 0)) return best;
  // The minimum stays inside the ellipsoid (x - centre)' P⁻¹ (x - centre) <= 1; every step keeps
  // the half that the subgradient points away from.
  VectorXd centre = best.scaling, g;
  MatrixXd P = kReach * kReach * MatrixXd::Identity(M.rows(), M.rows());
  for (int step = 0; step < 5000; ++step) {
    const double value = LogNorm(M, centre, g);
    if (value < std::log(best.value)) best = {std::exp(value), centre};
    const double width = std::sqrt(std::max(0.0, g.dot(P * g)));  // value - minimum is at most this
    if (width < accuracy) break;
    const VectorXd along = P * g / width;
    centre -= along / (n + 1);
    P = n * n / (n * n - 1) * (P - 2 / (n + 1) * along * along.transpose()).eval();
  }
  return best;
}

MuLower LargestLowerBound(const MatrixXcd& M) {
  const Index n = M.rows();
  MuLower best;
  const auto try_phases = [&](const VectorXcd& q) {
    const Eigen::ComplexEigenSolver<MatrixXcd> eigen(MatrixXcd(M * q.asDiagonal()), false);
    if (eigen.info() != Eigen::Success) return;
    Index k = 0;
    const double radius = eigen.eigenvalues().cwiseAbs().maxCoeff(&k);
    if (radius > best.value) best = {radius, q / eigen.eigenvalues()(k)};
  };
  for (Index start = 0; start <= n; ++start) {
    VectorXcd b(n), a(n), w(n), z(n);
    for (Index i = 0; i < n; ++i)
      b(i) = w(i) = std::polar(
          1 / std::sqrt(n), 2 * kPi * static_cast<double>(start * i) / static_cast<double>(n + 1));
    for (int k = 0; k < 100; ++k) {
      a = M * b;
      if (!(a.norm() > 0)) break;
      a.normalize();
      for (Index i = 0; i < n; ++i) z(i) = Phase(a(i)) * std::abs(w(i));
      w = M.adjoint() * z;
      if (!(w.norm() > 0)) break;
      w.normalize();
      for (Index i = 0; i < n; ++i) b(i) = Phase(w(i)) * std::abs(a(i));
    }
    VectorXcd q(n);
    for (Index i = 0; i < n; ++i) q(i) = Phase(w(i)) * std::conj(Phase(a(i)));
    try_phases(q);
  }
  return best;
}

}  // namespace ambrig
