#pragma once
/// min ½ xᵀA x - bᵀx with lo <= x <= hi, A symmetric and positive definite: a few dozen unknowns
/// (non-negative least squares from its normal equations). Active set, exact.
#include <Eigen/Dense>

namespace ambrig {

Eigen::VectorXd SolveInBox(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                           const Eigen::VectorXd& lo, const Eigen::VectorXd& hi);

}  // namespace ambrig
