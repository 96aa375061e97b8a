#include "control/synthesis/riccati.h"

#include <cmath>

#include "control/linear/state_space.h"
#include "core/base/parameters.h"
#include "core/math/linear_equations.h"

namespace ambrig {

RiccatiSolution SolveRiccati(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                             const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R) {
  constexpr int kMostIterations = 60;
  const Eigen::Index n = A.rows();
  Eigen::MatrixXd a = A, g = B * SolveSymmetricColumns(R, B.transpose()), h = Q;
  RiccatiSolution out;
  for (; out.iterations < kMostIterations; ++out.iterations) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> w(
        Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n) + g * h));
    const Eigen::MatrixXd wa = w.solve(a), wg = w.solve(g);
    const Eigen::MatrixXd dh = a.transpose() * h * wa;
    g += a * wg * a.transpose();
    g = (0.5 * (g + g.transpose())).eval();
    h += 0.5 * (dh + dh.transpose());
    a = (a * wa).eval();
    const double change = dh.norm() / h.norm();
    if (!std::isfinite(change) || change < 1e-15) break;
  }
  out.X = h;
  const Eigen::MatrixXd bx = B.transpose() * h;
  out.K = SolveSymmetricColumns(R + bx * B, bx * A);
  if (!out.K.allFinite() || !h.allFinite()) {
    out.residual = out.spectral_radius = kInfinity;
    return out;
  }
  out.residual = (A.transpose() * h * (A - B * out.K) + Q - h).norm() / h.norm();
  out.spectral_radius = SpectralRadius(A - B * out.K);
  return out;
}

}  // namespace ambrig
