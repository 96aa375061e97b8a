#include "analysis/balance.h"

#include <cmath>

namespace ambrig {

Eigen::VectorXd BalancingSizes(const Eigen::MatrixXd& A) {
  Eigen::MatrixXd B = A;
  Eigen::VectorXd d = Eigen::VectorXd::Ones(A.rows());
  for (bool changed = true; changed;) {
    changed = false;
    for (Eigen::Index k = 0; k < A.rows(); ++k) {
      const double own = std::abs(B(k, k));
      const double column = B.col(k).cwiseAbs().sum() - own, row = B.row(k).cwiseAbs().sum() - own;
      if (!(column > 0 && row > 0)) continue;
      const double f = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (column * f + row / f >= 0.95 * (column + row)) continue;
      d(k) *= f;
      B.col(k) *= f;
      B.row(k) /= f;
      changed = true;
    }
  }
  return d;
}

}  // namespace ambrig
