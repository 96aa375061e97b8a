#include "analysis/sampled_system.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/base/errors.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

/// Turns the 2 x 2 blocks of a real Schur form into triangles: T upper triangular, A = U T Uᴴ.
void Triangularise(MatrixXcd& T, MatrixXcd& U) {
  const Index n = T.rows();
  for (Index k = n - 2; k >= 0; --k) {
    const Complex below = T(k + 1, k);
    if (below == 0.0) continue;
    // an eigenvalue of the block, less its last element
    const Complex half = 0.5 * (T(k, k) - T(k + 1, k + 1));
    const Complex root = std::sqrt(half * half + T(k, k + 1) * below);
    const Complex over = half + (std::abs(half + root) > std::abs(half - root) ? root : -root);
    Eigen::JacobiRotation<Complex> turn;
    turn.makeGivens(over, below);
    T.rightCols(n - k).applyOnTheLeft(k, k + 1, turn.adjoint());
    T.topRows(k + 2).applyOnTheRight(k, k + 1, turn);
    U.applyOnTheRight(k, k + 1, turn);
    T(k + 1, k) = 0;
  }
}

}  // namespace

SampledSystem::SampledSystem(const MatrixXd& A, const MatrixXd& B, const MatrixXd& C) {
  const Eigen::RealSchur<MatrixXd> schur(A);
  Require(schur.info() == Eigen::Success, "converged eigenvalues of a sampled system");
  T_ = schur.matrixT().cast<Complex>();
  U_ = schur.matrixU().cast<Complex>();
  Triangularise(T_, U_);
  eigenvalues_ = T_.diagonal();
  B_ = U_.adjoint() * B.cast<Complex>();
  C_ = C.cast<Complex>() * U_;
}

MatrixXcd SampledSystem::Outputs(Complex z, const MatrixXcd& right) const {
  MatrixXcd shifted = -T_;
  shifted.diagonal().array() += z;
  return C_ * shifted.triangularView<Eigen::Upper>().solve(right);
}

MatrixXcd SampledSystem::At(Complex z) const { return Outputs(z, B_); }

MatrixXcd SampledSystem::At(Complex z, const std::vector<Index>& inputs) const {
  return Outputs(z, B_(Eigen::all, inputs));
}

Eigen::VectorXcd SampledSystem::Under(Complex z, const Eigen::VectorXcd& added) const {
  return Outputs(z, U_.adjoint() * added);
}

}  // namespace ambrig
