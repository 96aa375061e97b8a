#pragma once
/// The discrete algebraic Riccati equation of optimal control and, transposed, of the Kalman
/// filter:
///
///   X = A'X A - A'X B (R + B'X B)^-1 B'X A + Q,    K = (R + B'X B)^-1 B'X A,    A - B K stable
///
/// by the structure-preserving doubling algorithm, which squares the closed loop at every step.
/// Source: Chu, Fan, Lin, Wang, Int. J. Control 77 (2004) 767.
#include <Eigen/Dense>

namespace ambrig {

struct RiccatiSolution {
  Eigen::MatrixXd X, K;        // (n x n), (m x n)
  double residual = 0;         // of the equation, relative to X
  double spectral_radius = 0;  // of A - B K
  int iterations = 0;
  bool usable() const { return residual < 1e-6 && spectral_radius < 1; }
};

/// Q symmetric, non-negative (n x n); R symmetric, positive (m x m). Not usable where (A, B) cannot
/// be stabilised.
RiccatiSolution SolveRiccati(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                             const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R);

}  // namespace ambrig
