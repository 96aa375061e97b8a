#pragma once
/// Sizes d of the states of a linear system, powers of two, such that rows and columns of D⁻¹ A D
/// have like norms: metres, webers and newtons side by side cost eigenvalues and frequency
/// responses their digits otherwise. Source: Parlett & Reinsch 1969, Numer. Math. 13.
#include <Eigen/Dense>

namespace ambrig {

Eigen::VectorXd BalancingSizes(const Eigen::MatrixXd& A);

}  // namespace ambrig
